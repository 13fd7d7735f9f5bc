using System;

namespace UnityEngine
{
    /// A rotation in left-handed space; `a * b` applies b first. Euler angles are in degrees and rotate about z, then x, then y.
    public struct Quaternion : IEquatable<Quaternion>, IFormattable
    {
        public const float kEpsilon = 0.000001F;

        public float x;
        public float y;
        public float z;
        public float w;

        public Quaternion(float x, float y, float z, float w)
        {
            this.x = x;
            this.y = y;
            this.z = z;
            this.w = w;
        }

        public static Quaternion identity => new Quaternion(0f, 0f, 0f, 1f);

        public float this[int index]
        {
            readonly get => index switch
            {
                0 => x,
                1 => y,
                2 => z,
                3 => w,
                _ => throw new IndexOutOfRangeException("Invalid Quaternion index!"),
            };
            set
            {
                switch (index)
                {
                    case 0: x = value; break;
                    case 1: y = value; break;
                    case 2: z = value; break;
                    case 3: w = value; break;
                    default: throw new IndexOutOfRangeException("Invalid Quaternion index!");
                }
            }
        }

        public void Set(float newX, float newY, float newZ, float newW) => this = new Quaternion(newX, newY, newZ, newW);

        public static float Dot(Quaternion a, Quaternion b) => a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;

        public static Quaternion Inverse(Quaternion rotation)
        {
            var square = Dot(rotation, rotation);
            return new Quaternion(-rotation.x / square, -rotation.y / square, -rotation.z / square, rotation.w / square);
        }

        public readonly Quaternion normalized => Normalize(this);
        public void Normalize() => this = Normalize(this);

        public static Quaternion Normalize(Quaternion q)
        {
            var length = (float)Math.Sqrt(Dot(q, q));
            return length < Mathf.Epsilon ? identity : new Quaternion(q.x / length, q.y / length, q.z / length, q.w / length);
        }

        public static Quaternion AngleAxis(float angle, Vector3 axis)
        {
            var length = axis.magnitude;
            if (length < Vector3.kEpsilon) return identity;
            var half = angle * Mathf.Deg2Rad * 0.5f;
            var sine = Mathf.Sin(half) / length;
            return new Quaternion(axis.x * sine, axis.y * sine, axis.z * sine, Mathf.Cos(half));
        }

        public readonly void ToAngleAxis(out float angle, out Vector3 axis)
        {
            var q = normalized;
            angle = 2f * Mathf.Acos(Mathf.Clamp(q.w, -1f, 1f)) * Mathf.Rad2Deg;
            var sine = Mathf.Sqrt(1f - q.w * q.w);
            axis = sine < Vector3.kEpsilon ? Vector3.right : new Vector3(q.x / sine, q.y / sine, q.z / sine);
        }

        public static Quaternion Euler(Vector3 euler) => Euler(euler.x, euler.y, euler.z);

        public static Quaternion Euler(float x, float y, float z) =>
            AngleAxis(y, Vector3.up) * AngleAxis(x, Vector3.right) * AngleAxis(z, Vector3.forward);

        public Vector3 eulerAngles
        {
            readonly get
            {
                var q = normalized;
                var sineX = 2f * (q.w * q.x - q.y * q.z);
                Vector3 angles;
                if (Mathf.Abs(sineX) > 0.999999f) // straight up or down: only y - z or y + z is defined, so z is 0
                    angles = new Vector3(Mathf.Sign(sineX) * 90f, Mathf.Atan2(-2f * (q.x * q.z - q.w * q.y), 1f - 2f * (q.y * q.y + q.z * q.z)) * Mathf.Rad2Deg,
                        0f);
                else
                    angles = new Vector3(
                        Mathf.Asin(sineX),
                        Mathf.Atan2(2f * (q.x * q.z + q.w * q.y), 1f - 2f * (q.x * q.x + q.y * q.y)),
                        Mathf.Atan2(2f * (q.x * q.y + q.w * q.z), 1f - 2f * (q.x * q.x + q.z * q.z))) * Mathf.Rad2Deg;
                return new Vector3(Positive(angles.x), Positive(angles.y), Positive(angles.z));
            }
            set => this = Euler(value);
        }

        /// Returns an angle from 0 to 360. As in Unity, angles that are negative by rounding are kept.
        static float Positive(float angle) => angle < -0.0001f * Mathf.Rad2Deg ? angle + 360f : angle;

        public static Quaternion LookRotation(Vector3 forward) => LookRotation(forward, Vector3.up);

        public static Quaternion LookRotation(Vector3 forward, Vector3 upwards)
        {
            var axisZ = forward.normalized;
            if (axisZ.sqrMagnitude == 0f)
            {
                Debug.Log("Look rotation viewing vector is zero");
                return identity;
            }
            var axisX = Vector3.Cross(upwards, axisZ).normalized;
            return axisX.sqrMagnitude == 0f
                ? FromToRotation(Vector3.forward, axisZ)
                : FromAxes(axisX, Vector3.Cross(axisZ, axisX), axisZ);
        }

        public void SetLookRotation(Vector3 view) => this = LookRotation(view);
        public void SetLookRotation(Vector3 view, Vector3 up) => this = LookRotation(view, up);

        /// Returns the rotation that maps the x, y and z axes to these orthonormal vectors.
        internal static Quaternion FromAxes(Vector3 axisX, Vector3 axisY, Vector3 axisZ)
        {
            var trace = axisX.x + axisY.y + axisZ.z;
            if (trace > 0f)
            {
                var s = Mathf.Sqrt(trace + 1f) * 2f;
                return new Quaternion((axisY.z - axisZ.y) / s, (axisZ.x - axisX.z) / s, (axisX.y - axisY.x) / s, s / 4f);
            }
            if (axisX.x >= axisY.y && axisX.x >= axisZ.z)
            {
                var s = Mathf.Sqrt(1f + axisX.x - axisY.y - axisZ.z) * 2f;
                return new Quaternion(s / 4f, (axisY.x + axisX.y) / s, (axisZ.x + axisX.z) / s, (axisY.z - axisZ.y) / s);
            }
            if (axisY.y >= axisZ.z)
            {
                var s = Mathf.Sqrt(1f + axisY.y - axisX.x - axisZ.z) * 2f;
                return new Quaternion((axisY.x + axisX.y) / s, s / 4f, (axisZ.y + axisY.z) / s, (axisZ.x - axisX.z) / s);
            }
            else
            {
                var s = Mathf.Sqrt(1f + axisZ.z - axisX.x - axisY.y) * 2f;
                return new Quaternion((axisZ.x + axisX.z) / s, (axisZ.y + axisY.z) / s, s / 4f, (axisX.y - axisY.x) / s);
            }
        }

        public static Quaternion FromToRotation(Vector3 fromDirection, Vector3 toDirection)
        {
            Vector3 from = fromDirection.normalized, to = toDirection.normalized;
            if (from.sqrMagnitude == 0f || to.sqrMagnitude == 0f) return identity;
            var cosine = Vector3.Dot(from, to);
            if (cosine < -0.999999f)
            {
                // As in Unity, up turns to down about x, and right to left about y.
                var side = Vector3.Cross(from, Vector3.right);
                if (side.sqrMagnitude < Vector3.kEpsilon) side = Vector3.Cross(from, Vector3.down);
                return AngleAxis(180f, Vector3.Cross(side, from));
            }
            var axis = Vector3.Cross(from, to);
            return Normalize(new Quaternion(axis.x, axis.y, axis.z, 1f + cosine));
        }

        public void SetFromToRotation(Vector3 fromDirection, Vector3 toDirection) => this = FromToRotation(fromDirection, toDirection);

        public static Quaternion Slerp(Quaternion a, Quaternion b, float t) => SlerpUnclamped(a, b, Mathf.Clamp01(t));

        public static Quaternion SlerpUnclamped(Quaternion a, Quaternion b, float t)
        {
            var cosine = Dot(a, b);
            var sign = cosine < 0f ? -1f : 1f;
            cosine *= sign;
            if (cosine > 0.9995f) return LerpUnclamped(a, b, t);
            var angle = Mathf.Acos(cosine);
            var sine = Mathf.Sin(angle);
            return Blend(a, Mathf.Sin((1f - t) * angle) / sine, b, sign * Mathf.Sin(t * angle) / sine);
        }

        public static Quaternion Lerp(Quaternion a, Quaternion b, float t) => LerpUnclamped(a, b, Mathf.Clamp01(t));
        public static Quaternion LerpUnclamped(Quaternion a, Quaternion b, float t) => Normalize(Blend(a, 1f - t, b, Dot(a, b) < 0f ? -t : t));

        static Quaternion Blend(Quaternion a, float s, Quaternion b, float t) =>
            new Quaternion(a.x * s + b.x * t, a.y * s + b.y * t, a.z * s + b.z * t, a.w * s + b.w * t);

        public static Quaternion RotateTowards(Quaternion from, Quaternion to, float maxDegreesDelta)
        {
            var angle = Angle(from, to);
            return angle == 0f ? to : SlerpUnclamped(from, to, Mathf.Min(1f, maxDegreesDelta / angle));
        }

        public static float Angle(Quaternion a, Quaternion b)
        {
            var cosine = Mathf.Min(Mathf.Abs(Dot(a, b)), 1f);
            return cosine > 1f - kEpsilon ? 0f : Mathf.Acos(cosine) * 2f * Mathf.Rad2Deg;
        }

        public static Quaternion operator *(Quaternion lhs, Quaternion rhs) => new Quaternion(
            lhs.w * rhs.x + lhs.x * rhs.w + lhs.y * rhs.z - lhs.z * rhs.y,
            lhs.w * rhs.y + lhs.y * rhs.w + lhs.z * rhs.x - lhs.x * rhs.z,
            lhs.w * rhs.z + lhs.z * rhs.w + lhs.x * rhs.y - lhs.y * rhs.x,
            lhs.w * rhs.w - lhs.x * rhs.x - lhs.y * rhs.y - lhs.z * rhs.z);

        public static Vector3 operator *(Quaternion rotation, Vector3 point)
        {
            // v + 2w(u x v) + 2u x (u x v), u the vector part
            float ux = rotation.x, uy = rotation.y, uz = rotation.z;
            float tx = 2f * (uy * point.z - uz * point.y), ty = 2f * (uz * point.x - ux * point.z), tz = 2f * (ux * point.y - uy * point.x);
            return new Vector3(
                point.x + rotation.w * tx + uy * tz - uz * ty,
                point.y + rotation.w * ty + uz * tx - ux * tz,
                point.z + rotation.w * tz + ux * ty - uy * tx);
        }

        public static bool operator ==(Quaternion lhs, Quaternion rhs) => Dot(lhs, rhs) > 1f - kEpsilon;
        public static bool operator !=(Quaternion lhs, Quaternion rhs) => !(lhs == rhs);

        public readonly bool Equals(Quaternion other) => x.Equals(other.x) && y.Equals(other.y) && z.Equals(other.z) && w.Equals(other.w);
        public override readonly bool Equals(object other) => other is Quaternion quaternion && Equals(quaternion);
        public override readonly int GetHashCode() => x.GetHashCode() ^ (y.GetHashCode() << 2) ^ (z.GetHashCode() >> 2) ^ (w.GetHashCode() >> 1);
        public override readonly string ToString() => ToString(null);
        public readonly string ToString(string format) => ToString(format, null);
        public readonly string ToString(string format, IFormatProvider formatProvider) =>
            ValueText.Of("F5", format, formatProvider, x, y, z, w);
    }
}
