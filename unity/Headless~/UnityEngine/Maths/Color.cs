using System;

namespace UnityEngine
{
    public struct Color : IEquatable<Color>, IFormattable
    {
        public float r;
        public float g;
        public float b;
        public float a;

        public Color(float r, float g, float b, float a)
        {
            this.r = r;
            this.g = g;
            this.b = b;
            this.a = a;
        }

        public Color(float r, float g, float b) : this(r, g, b, 1f) { }

        public static Color black => new Color(0f, 0f, 0f);
        public static Color blue => new Color(0f, 0f, 1f);
        public static Color clear => new Color(0f, 0f, 0f, 0f);
        public static Color cyan => new Color(0f, 1f, 1f);
        public static Color gray => new Color(0.5f, 0.5f, 0.5f);
        public static Color grey => gray;
        public static Color green => new Color(0f, 1f, 0f);
        public static Color magenta => new Color(1f, 0f, 1f);
        public static Color red => new Color(1f, 0f, 0f);
        public static Color white => new Color(1f, 1f, 1f);
        public static Color yellow => new Color(1f, 235f / 255f, 4f / 255f);

        public readonly float grayscale => 0.299f * r + 0.587f * g + 0.114f * b;

        public static Color Lerp(Color a, Color b, float t) => LerpUnclamped(a, b, Mathf.Clamp01(t));
        public static Color LerpUnclamped(Color a, Color b, float t) => a + (b - a) * t;

        public static Color HSVToRGB(float H, float S, float V)
        {
            if (S != 0f && !(H * 6f >= -1f && H * 6f < 7f)) return black; // as in Unity
            return new Color(Channel(5f), Channel(3f), Channel(1f));

            float Channel(float offset)
            {
                var k = Mathf.Repeat(offset + H * 6f, 6f);
                return V - V * S * Mathf.Clamp01(Mathf.Min(k, 4f - k));
            }
        }

        public static void RGBToHSV(Color rgbColor, out float H, out float S, out float V)
        {
            V = Mathf.Max(rgbColor.r, Mathf.Max(rgbColor.g, rgbColor.b));
            var range = V - Mathf.Min(rgbColor.r, Mathf.Min(rgbColor.g, rgbColor.b));
            S = V == 0f ? 0f : range / V;
            if (range == 0f) H = 0f;
            else if (V == rgbColor.r) H = Mathf.Repeat((rgbColor.g - rgbColor.b) / range / 6f, 1f);
            else if (V == rgbColor.g) H = (2f + (rgbColor.b - rgbColor.r) / range) / 6f;
            else H = (4f + (rgbColor.r - rgbColor.g) / range) / 6f;
        }

        public static Color operator +(Color a, Color b) => new Color(a.r + b.r, a.g + b.g, a.b + b.b, a.a + b.a);
        public static Color operator -(Color a, Color b) => new Color(a.r - b.r, a.g - b.g, a.b - b.b, a.a - b.a);
        public static Color operator *(Color a, Color b) => new Color(a.r * b.r, a.g * b.g, a.b * b.b, a.a * b.a);
        public static Color operator *(Color a, float b) => new Color(a.r * b, a.g * b, a.b * b, a.a * b);
        public static Color operator *(float b, Color a) => a * b;
        public static Color operator /(Color a, float b) => new Color(a.r / b, a.g / b, a.b / b, a.a / b);
        public static bool operator ==(Color lhs, Color rhs) => (Vector4)lhs == (Vector4)rhs;
        public static bool operator !=(Color lhs, Color rhs) => !(lhs == rhs);
        public static implicit operator Vector4(Color c) => new Vector4(c.r, c.g, c.b, c.a);
        public static implicit operator Color(Vector4 v) => new Color(v.x, v.y, v.z, v.w);

        public readonly bool Equals(Color other) => r.Equals(other.r) && g.Equals(other.g) && b.Equals(other.b) && a.Equals(other.a);
        public override readonly bool Equals(object other) => other is Color color && Equals(color);
        public override readonly int GetHashCode() => ((Vector4)this).GetHashCode();
        public override readonly string ToString() => ToString(null);
        public readonly string ToString(string format) => ToString(format, null);
        public readonly string ToString(string format, IFormatProvider formatProvider) =>
            "RGBA" + ValueText.Of("F3", format, formatProvider, r, g, b, a);
    }
}
