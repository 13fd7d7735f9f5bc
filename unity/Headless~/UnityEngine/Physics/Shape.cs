using System;

namespace UnityEngine
{
    /// A box swollen by a radius: a sphere has no half extents, a capsule only one along its z, a box no radius.
    struct Shape
    {
        public Vector3 Center;
        public Quaternion Rotation;
        public Vector3 Half;
        public float Radius;

        public readonly bool IsSphere => Half.x == 0f && Half.y == 0f && Half.z == 0f && Radius > 0f;
        public readonly bool IsCapsule => Half.z > 0f && Radius > 0f;

        /// Seen from outside a frame at that position with that rotation.
        public readonly Shape Within(Vector3 position, Quaternion rotation)
        {
            var shape = this;
            shape.Center = position + rotation * Center;
            shape.Rotation = rotation * Rotation;
            return shape;
        }

        /// Half the size of the upright box around it.
        public readonly Vector3 Reach
        {
            get
            {
                if (IsSphere) return new Vector3(Radius, Radius, Radius);
                Vector3 x = Rotation * new Vector3(Half.x, 0f, 0f), y = Rotation * new Vector3(0f, Half.y, 0f), z = Rotation * new Vector3(0f, 0f, Half.z);
                return new Vector3(
                    Mathf.Abs(x.x) + Mathf.Abs(y.x) + Mathf.Abs(z.x) + Radius,
                    Mathf.Abs(x.y) + Mathf.Abs(y.y) + Mathf.Abs(z.y) + Radius,
                    Mathf.Abs(x.z) + Mathf.Abs(y.z) + Mathf.Abs(z.z) + Radius);
            }
        }

        /// The point itself where it is inside.
        public readonly Vector3 ClosestPoint(Vector3 point)
        {
            var local = Quaternion.Inverse(Rotation) * (point - Center);
            var core = Vector3.Max(-Half, Vector3.Min(Half, local));
            var beyond = local - core;
            var distance = beyond.magnitude;
            if (distance <= Radius) return point;
            return Center + Rotation * (Radius > 0f ? core + beyond * (Radius / distance) : core);
        }

        public readonly bool TouchesSphere(in Vector3 center, float radius)
        {
            if (!IsSphere) return (ClosestPoint(center) - center).sqrMagnitude <= radius * radius;
            float x = center.x - Center.x, y = center.y - Center.y, z = center.z - Center.z, reach = radius + Radius;
            return x * x + y * y + z * z <= reach * reach;
        }

        /// Where a ray (unit direction) enters; a ray that starts inside does not hit.
        public readonly bool Raycast(Vector3 origin, Vector3 direction, float maxDistance, out float distance, out Vector3 normal)
        {
            var unturn = Quaternion.Inverse(Rotation);
            Vector3 from = unturn * (origin - Center), way = unturn * direction;
            var hit = Radius == 0f ? HitsBox(from, way, out distance, out normal)
                : IsCapsule ? HitsCapsule(from, way, out distance, out normal)
                : HitsBall(from, way, Vector3.zero, out distance, out normal);
            normal = Rotation * normal;
            return hit && distance <= maxDistance;
        }

        readonly bool HitsBox(Vector3 from, Vector3 way, out float distance, out Vector3 normal)
        {
            float enter = float.NegativeInfinity, leave = float.PositiveInfinity;
            distance = 0f;
            normal = Vector3.zero;
            for (var axis = 0; axis < 3; axis++)
            {
                if (way[axis] == 0f)
                {
                    if (Mathf.Abs(from[axis]) > Half[axis]) return false;
                    continue;
                }
                float sign = Mathf.Sign(way[axis]);
                float near = (-sign * Half[axis] - from[axis]) / way[axis], far = (sign * Half[axis] - from[axis]) / way[axis];
                if (near > enter)
                {
                    enter = near;
                    normal = Vector3.zero;
                    normal[axis] = -sign;
                }
                leave = Mathf.Min(leave, far);
            }
            distance = enter;
            return enter >= 0f && enter <= leave;
        }

        readonly bool HitsBall(Vector3 from, Vector3 way, Vector3 center, out float distance, out Vector3 normal)
        {
            var toCenter = center - from;
            float along = Vector3.Dot(toCenter, way), outside = toCenter.sqrMagnitude - Radius * Radius;
            var discriminant = along * along - outside;
            distance = 0f;
            normal = Vector3.zero;
            if (outside < 0f || along < 0f || discriminant < 0f) return false;
            distance = along - (float)Math.Sqrt(discriminant);
            normal = (from + way * distance - center) / Radius;
            return true;
        }

        readonly bool HitsCapsule(Vector3 from, Vector3 way, out float distance, out Vector3 normal)
        {
            // The wall between the end balls first: a circle in the plane across the axis (z).
            float a = way.x * way.x + way.y * way.y, b = from.x * way.x + from.y * way.y, c = from.x * from.x + from.y * from.y - Radius * Radius;
            distance = 0f;
            normal = Vector3.zero;
            if (c < 0f && Mathf.Abs(from.z) <= Half.z) return false;
            var discriminant = b * b - a * c;
            if (a > 0f && discriminant >= 0f)
            {
                distance = (-b - (float)Math.Sqrt(discriminant)) / a;
                var point = from + way * distance;
                if (distance >= 0f && Mathf.Abs(point.z) <= Half.z)
                {
                    normal = new Vector3(point.x, point.y, 0f) / Radius;
                    return true;
                }
            }
            var end = new Vector3(0f, 0f, Half.z);
            if ((from - end).sqrMagnitude < Radius * Radius || (from + end).sqrMagnitude < Radius * Radius) return false;
            bool top = HitsBall(from, way, end, out var topDistance, out var topNormal),
                bottom = HitsBall(from, way, -end, out var bottomDistance, out var bottomNormal);
            if (!top && !bottom) return false;
            var useTop = top && (!bottom || topDistance <= bottomDistance);
            distance = useTop ? topDistance : bottomDistance;
            normal = useTop ? topNormal : bottomNormal;
            return true;
        }
    }
}
