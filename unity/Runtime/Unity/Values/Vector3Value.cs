using System.ComponentModel;
using System.Runtime.InteropServices;
using Collektive.Bridge;

namespace org.collektive.schema
{
    /// <summary>Mirror of <c>Vector3</c> of <c>types.fbs</c>.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Vector3Value : IMirror
    {
        /// <summary>Field <c>x</c>.</summary>
        public float X;

        /// <summary>Field <c>y</c>.</summary>
        public float Y;

        /// <summary>Field <c>z</c>.</summary>
        public float Z;

        /// <summary>Creates a value from its fields.</summary>
        public Vector3Value(float x, float y, float z)
        {
            X = x;
            Y = y;
            Z = z;
        }

        /// <summary>Converts to schema data.</summary>
        public static implicit operator Vector3Value(UnityEngine.Vector3 value) => new Vector3Value(value.x, value.y, value.z);

        /// <summary>Converts to Unity's type.</summary>
        public static implicit operator UnityEngine.Vector3(Vector3Value value) => new UnityEngine.Vector3(value.X, value.Y, value.Z);

        /// <inheritdoc/>
        [EditorBrowsable(EditorBrowsableState.Never)]
        public string FindNotFinite()
        {
            if (!float.IsFinite(X)) return "x";
            if (!float.IsFinite(Y)) return "y";
            if (!float.IsFinite(Z)) return "z";
            return null;
        }
    }
}
