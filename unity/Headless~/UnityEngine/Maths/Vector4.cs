using System;

namespace UnityEngine
{
    public struct Vector4 : IEquatable<Vector4>, IFormattable
    {
        public float x;
        public float y;
        public float z;
        public float w;

        public Vector4(float x, float y, float z, float w)
        {
            this.x = x;
            this.y = y;
            this.z = z;
            this.w = w;
        }

        public static implicit operator Vector4(Vector3 v) => new Vector4(v.x, v.y, v.z, 0f);
        public static implicit operator Vector3(Vector4 v) => new Vector3(v.x, v.y, v.z);

        public static bool operator ==(Vector4 a, Vector4 b)
        {
            float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z, w = a.w - b.w;
            return x * x + y * y + z * z + w * w < Vector3.kEpsilon * Vector3.kEpsilon;
        }

        public static bool operator !=(Vector4 a, Vector4 b) => !(a == b);

        public bool Equals(Vector4 other) => x == other.x && y == other.y && z == other.z && w == other.w;
        public override bool Equals(object other) => other is Vector4 vector && Equals(vector);
        public override int GetHashCode() => x.GetHashCode() ^ (y.GetHashCode() << 2) ^ (z.GetHashCode() >> 2) ^ (w.GetHashCode() >> 1);
        public override string ToString() => ToString(null);
        public string ToString(string format) => ToString(format, null);
        public string ToString(string format, IFormatProvider formatProvider) => ValueText.Of("F2", format, formatProvider, x, y, z, w);
    }
}
