using System;

namespace UnityEngine
{
    public struct Bounds : IEquatable<Bounds>, IFormattable
    {
        public Bounds(Vector3 center, Vector3 size)
        {
            this.center = center;
            extents = size * 0.5f;
        }

        public Vector3 center { readonly get; set; }
        public Vector3 extents { readonly get; set; }
        public Vector3 size { readonly get => extents * 2f; set => extents = value * 0.5f; }
        public Vector3 min { readonly get => center - extents; set => SetMinMax(value, max); }
        public Vector3 max { readonly get => center + extents; set => SetMinMax(min, value); }

        public void SetMinMax(Vector3 min, Vector3 max)
        {
            extents = (max - min) * 0.5f;
            center = min + extents;
        }

        public void Encapsulate(Vector3 point) => SetMinMax(Vector3.Min(min, point), Vector3.Max(max, point));

        public void Encapsulate(Bounds bounds)
        {
            Encapsulate(bounds.min);
            Encapsulate(bounds.max);
        }

        public void Expand(float amount) => extents += Vector3.one * (amount * 0.5f);
        public void Expand(Vector3 amount) => extents += amount * 0.5f;

        public readonly bool Intersects(Bounds bounds) =>
            min.x <= bounds.max.x && max.x >= bounds.min.x && min.y <= bounds.max.y && max.y >= bounds.min.y && min.z <= bounds.max.z && max.z >= bounds.min.z;

        /// As in Unity, bounds with negative extents contain no points.
        public readonly bool Contains(Vector3 point) => Vector3.Max(min, point).Equals(point) && Vector3.Min(max, point).Equals(point);
        public readonly Vector3 ClosestPoint(Vector3 point) => Vector3.Max(min, Vector3.Min(max, point));
        public readonly float SqrDistance(Vector3 point) => (ClosestPoint(point) - point).sqrMagnitude;

        public static bool operator ==(Bounds lhs, Bounds rhs) => lhs.center == rhs.center && lhs.extents == rhs.extents;
        public static bool operator !=(Bounds lhs, Bounds rhs) => !(lhs == rhs);

        public readonly bool Equals(Bounds other) => center.Equals(other.center) && extents.Equals(other.extents);
        public override readonly bool Equals(object other) => other is Bounds bounds && Equals(bounds);
        public override readonly int GetHashCode() => center.GetHashCode() ^ (extents.GetHashCode() << 2);
        public override readonly string ToString() => ToString(null);
        public readonly string ToString(string format) => ToString(format, null);
        public readonly string ToString(string format, IFormatProvider formatProvider) =>
            $"Center: {center.ToString(format, formatProvider)}, Extents: {extents.ToString(format, formatProvider)}";
    }
}
