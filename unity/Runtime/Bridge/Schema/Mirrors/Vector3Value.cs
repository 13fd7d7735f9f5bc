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

        /// <inheritdoc/>
        public string FindNotFinite()
        {
            if (!float.IsFinite(X)) return "x";
            if (!float.IsFinite(Y)) return "y";
            if (!float.IsFinite(Z)) return "z";
            return null;
        }
    }
}
