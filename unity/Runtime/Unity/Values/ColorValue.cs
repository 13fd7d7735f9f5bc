using System.ComponentModel;
using System.Runtime.InteropServices;
using Collektive.Bridge;

namespace org.collektive.schema
{
    /// <summary>Mirror of <c>Color</c> of <c>types.fbs</c>: linear colour, each channel 0..1.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct ColorValue : IMirror
    {
        /// <summary>Field <c>r</c>.</summary>
        public float R;

        /// <summary>Field <c>g</c>.</summary>
        public float G;

        /// <summary>Field <c>b</c>.</summary>
        public float B;

        /// <summary>Field <c>a</c>.</summary>
        public float A;

        /// <summary>Creates a value from its fields.</summary>
        public ColorValue(float r, float g, float b, float a)
        {
            R = r;
            G = g;
            B = b;
            A = a;
        }

        /// <summary>Converts to schema data. Unity's colour is treated as linear.</summary>
        public static implicit operator ColorValue(UnityEngine.Color value) => new ColorValue(value.r, value.g, value.b, value.a);

        /// <summary>Converts to Unity's type.</summary>
        public static implicit operator UnityEngine.Color(ColorValue value) => new UnityEngine.Color(value.R, value.G, value.B, value.A);

        /// <inheritdoc/>
        [EditorBrowsable(EditorBrowsableState.Never)]
        public string FindNotFinite()
        {
            if (!float.IsFinite(R)) return "r";
            if (!float.IsFinite(G)) return "g";
            if (!float.IsFinite(B)) return "b";
            if (!float.IsFinite(A)) return "a";
            return null;
        }
    }
}
