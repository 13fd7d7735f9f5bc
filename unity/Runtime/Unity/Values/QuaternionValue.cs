using System.ComponentModel;
using System.Runtime.InteropServices;
using Collektive.Bridge;

namespace org.collektive.schema
{
    /// <summary>Mirror of <c>Quaternion</c> of <c>types.fbs</c>.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct QuaternionValue : IMirror
    {
        /// <summary>Field <c>x</c>.</summary>
        public float X;

        /// <summary>Field <c>y</c>.</summary>
        public float Y;

        /// <summary>Field <c>z</c>.</summary>
        public float Z;

        /// <summary>Field <c>w</c>.</summary>
        public float W;

        /// <summary>Creates a value from its fields.</summary>
        public QuaternionValue(float x, float y, float z, float w)
        {
            X = x;
            Y = y;
            Z = z;
            W = w;
        }

        /// <summary>Converts to schema data.</summary>
        public static implicit operator QuaternionValue(UnityEngine.Quaternion value) => new QuaternionValue(value.x, value.y, value.z, value.w);

        /// <summary>Converts to Unity's type.</summary>
        public static implicit operator UnityEngine.Quaternion(QuaternionValue value) => new UnityEngine.Quaternion(value.X, value.Y, value.Z, value.W);

        /// <inheritdoc/>
        [EditorBrowsable(EditorBrowsableState.Never)]
        public string FindNotFinite()
        {
            if (!float.IsFinite(X)) return "x";
            if (!float.IsFinite(Y)) return "y";
            if (!float.IsFinite(Z)) return "z";
            if (!float.IsFinite(W)) return "w";
            return null;
        }
    }
}
