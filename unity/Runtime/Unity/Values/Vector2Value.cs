using System.ComponentModel;
using System.Runtime.InteropServices;
using Collektive.Bridge;

namespace org.collektive.schema
{
    /// <summary>Mirror of <c>Vector2</c> of <c>types.fbs</c>.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Vector2Value : IMirror
    {
        /// <summary>Field <c>x</c>.</summary>
        public float X;

        /// <summary>Field <c>y</c>.</summary>
        public float Y;

        /// <summary>Creates a value from its fields.</summary>
        public Vector2Value(float x, float y)
        {
            X = x;
            Y = y;
        }

        /// <summary>Converts to schema data.</summary>
        public static implicit operator Vector2Value(UnityEngine.Vector2 value) => new Vector2Value(value.x, value.y);

        /// <summary>Converts to Unity's type.</summary>
        public static implicit operator UnityEngine.Vector2(Vector2Value value) => new UnityEngine.Vector2(value.X, value.Y);

        /// <inheritdoc/>
        [EditorBrowsable(EditorBrowsableState.Never)]
        public string FindNotFinite()
        {
            if (!float.IsFinite(X)) return "x";
            if (!float.IsFinite(Y)) return "y";
            return null;
        }
    }
}
