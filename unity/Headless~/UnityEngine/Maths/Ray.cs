using System;

namespace UnityEngine
{
    public struct Ray : IFormattable
    {
        Vector3 unitDirection;

        public Ray(Vector3 origin, Vector3 direction)
        {
            this.origin = origin;
            unitDirection = direction.normalized;
        }

        public Vector3 origin { readonly get; set; }
        public Vector3 direction { readonly get => unitDirection; set => unitDirection = value.normalized; }
        public readonly Vector3 GetPoint(float distance) => origin + unitDirection * distance;
        public override readonly string ToString() => ToString(null);
        public readonly string ToString(string format) => ToString(format, null);
        public readonly string ToString(string format, IFormatProvider formatProvider) =>
            $"Origin: {origin.ToString(format, formatProvider)}, Dir: {unitDirection.ToString(format, formatProvider)}";
    }
}
