using System;

namespace UnityEngine
{
    /// A matrix for column vectors: `m03, m13, m23` is the translation, and `a * b` applies b first.
    public struct Matrix4x4 : IEquatable<Matrix4x4>, IFormattable
    {
        public float m00;
        public float m10;
        public float m20;
        public float m30;
        public float m01;
        public float m11;
        public float m21;
        public float m31;
        public float m02;
        public float m12;
        public float m22;
        public float m32;
        public float m03;
        public float m13;
        public float m23;
        public float m33;

        public Matrix4x4(Vector4 column0, Vector4 column1, Vector4 column2, Vector4 column3)
        {
            m00 = column0.x; m10 = column0.y; m20 = column0.z; m30 = column0.w;
            m01 = column1.x; m11 = column1.y; m21 = column1.z; m31 = column1.w;
            m02 = column2.x; m12 = column2.y; m22 = column2.z; m32 = column2.w;
            m03 = column3.x; m13 = column3.y; m23 = column3.z; m33 = column3.w;
        }

        public static Matrix4x4 zero => default;
        public static Matrix4x4 identity => Scale(Vector3.one);

        public float this[int row, int column]
        {
            readonly get => this[row + column * 4];
            set => this[row + column * 4] = value;
        }

        public float this[int index]
        {
            readonly get => index switch
            {
                0 => m00, 1 => m10, 2 => m20, 3 => m30,
                4 => m01, 5 => m11, 6 => m21, 7 => m31,
                8 => m02, 9 => m12, 10 => m22, 11 => m32,
                12 => m03, 13 => m13, 14 => m23, 15 => m33,
                _ => throw new IndexOutOfRangeException("Invalid matrix index!"),
            };
            set
            {
                switch (index)
                {
                    case 0: m00 = value; break;
                    case 1: m10 = value; break;
                    case 2: m20 = value; break;
                    case 3: m30 = value; break;
                    case 4: m01 = value; break;
                    case 5: m11 = value; break;
                    case 6: m21 = value; break;
                    case 7: m31 = value; break;
                    case 8: m02 = value; break;
                    case 9: m12 = value; break;
                    case 10: m22 = value; break;
                    case 11: m32 = value; break;
                    case 12: m03 = value; break;
                    case 13: m13 = value; break;
                    case 14: m23 = value; break;
                    case 15: m33 = value; break;
                    default: throw new IndexOutOfRangeException("Invalid matrix index!");
                }
            }
        }

        public readonly Vector4 GetColumn(int index) => new Vector4(this[0, index], this[1, index], this[2, index], this[3, index]);

        public static Matrix4x4 Scale(Vector3 vector) => new Matrix4x4 { m00 = vector.x, m11 = vector.y, m22 = vector.z, m33 = 1f };

        public static Matrix4x4 Translate(Vector3 vector)
        {
            var matrix = identity;
            matrix.m03 = vector.x;
            matrix.m13 = vector.y;
            matrix.m23 = vector.z;
            return matrix;
        }

        public static Matrix4x4 Rotate(Quaternion q) => TRS(Vector3.zero, q, Vector3.one);

        public static Matrix4x4 TRS(Vector3 pos, Quaternion q, Vector3 s)
        {
            Vector3 x = q * new Vector3(s.x, 0f, 0f), y = q * new Vector3(0f, s.y, 0f), z = q * new Vector3(0f, 0f, s.z);
            return new Matrix4x4(x, y, z, new Vector4(pos.x, pos.y, pos.z, 1f));
        }

        public void SetTRS(Vector3 pos, Quaternion q, Vector3 s) => this = TRS(pos, q, s);

        public static Matrix4x4 operator *(Matrix4x4 lhs, Matrix4x4 rhs)
        {
            var result = default(Matrix4x4);
            for (var row = 0; row < 4; row++)
                for (var column = 0; column < 4; column++)
                    result[row, column] = lhs[row, 0] * rhs[0, column] + lhs[row, 1] * rhs[1, column] + lhs[row, 2] * rhs[2, column]
                        + lhs[row, 3] * rhs[3, column];
            return result;
        }

        public static Vector4 operator *(Matrix4x4 lhs, Vector4 vector) => new Vector4(
            lhs.m00 * vector.x + lhs.m01 * vector.y + lhs.m02 * vector.z + lhs.m03 * vector.w,
            lhs.m10 * vector.x + lhs.m11 * vector.y + lhs.m12 * vector.z + lhs.m13 * vector.w,
            lhs.m20 * vector.x + lhs.m21 * vector.y + lhs.m22 * vector.z + lhs.m23 * vector.w,
            lhs.m30 * vector.x + lhs.m31 * vector.y + lhs.m32 * vector.z + lhs.m33 * vector.w);

        public readonly Vector3 GetPosition() => new Vector3(m03, m13, m23);
        public readonly Vector3 MultiplyVector(Vector3 vector) => new Vector3(
            m00 * vector.x + m01 * vector.y + m02 * vector.z,
            m10 * vector.x + m11 * vector.y + m12 * vector.z,
            m20 * vector.x + m21 * vector.y + m22 * vector.z);
        public readonly Vector3 MultiplyPoint3x4(Vector3 point) => MultiplyVector(point) + GetPosition();
        public readonly Vector3 MultiplyPoint(Vector3 point) =>
            MultiplyPoint3x4(point) / (m30 * point.x + m31 * point.y + m32 * point.z + m33);

        public readonly Vector3 lossyScale
        {
            get
            {
                Vector3 x = new Vector3(m00, m10, m20), y = new Vector3(m01, m11, m21), z = new Vector3(m02, m12, m22);
                var mirrored = Vector3.Dot(Vector3.Cross(x, y), z) < 0f;
                return new Vector3(mirrored ? -x.magnitude : x.magnitude, y.magnitude, z.magnitude);
            }
        }

        public readonly Quaternion rotation
        {
            get
            {
                var scale = lossyScale;
                return Quaternion.FromAxes(new Vector3(m00, m10, m20) / scale.x, new Vector3(m01, m11, m21) / scale.y, new Vector3(m02, m12, m22) / scale.z);
            }
        }

        public readonly Matrix4x4 transpose
        {
            get
            {
                var result = default(Matrix4x4);
                for (var row = 0; row < 4; row++)
                    for (var column = 0; column < 4; column++) result[row, column] = this[column, row];
                return result;
            }
        }

        /// The inverse, computed by Gauss-Jordan elimination with row pivots; the zero matrix if this matrix is singular.
        public readonly Matrix4x4 inverse
        {
            get
            {
                Matrix4x4 left = this, right = identity;
                for (var column = 0; column < 4; column++)
                {
                    var pivot = column;
                    for (var row = column + 1; row < 4; row++)
                        if (Mathf.Abs(left[row, column]) > Mathf.Abs(left[pivot, column])) pivot = row;
                    if (left[pivot, column] == 0f) return zero;
                    var scale = 1f / left[pivot, column];
                    for (var k = 0; k < 4; k++)
                    {
                        float a = left[pivot, k] * scale, b = right[pivot, k] * scale;
                        left[pivot, k] = left[column, k];
                        right[pivot, k] = right[column, k];
                        left[column, k] = a;
                        right[column, k] = b;
                    }
                    for (var row = 0; row < 4; row++)
                    {
                        var factor = left[row, column];
                        if (row == column || factor == 0f) continue;
                        for (var k = 0; k < 4; k++)
                        {
                            left[row, k] -= factor * left[column, k];
                            right[row, k] -= factor * right[column, k];
                        }
                    }
                }
                return right;
            }
        }

        public static bool operator ==(Matrix4x4 lhs, Matrix4x4 rhs)
        {
            for (var column = 0; column < 4; column++)
                if (lhs.GetColumn(column) != rhs.GetColumn(column)) return false;
            return true;
        }

        public static bool operator !=(Matrix4x4 lhs, Matrix4x4 rhs) => !(lhs == rhs);

        public readonly bool Equals(Matrix4x4 other)
        {
            for (var index = 0; index < 16; index++)
                if (this[index] != other[index]) return false;
            return true;
        }

        public override readonly bool Equals(object other) => other is Matrix4x4 matrix && Equals(matrix);

        public override readonly int GetHashCode()
        {
            var hash = 0;
            for (var index = 0; index < 16; index++) hash = hash * 31 + this[index].GetHashCode();
            return hash;
        }

        public override readonly string ToString() => ToString(null);
        public readonly string ToString(string format) => ToString(format, null);

        public readonly string ToString(string format, IFormatProvider formatProvider)
        {
            var text = "";
            for (var row = 0; row < 4; row++)
                text += ValueText.Join("\t", "F5", format, formatProvider, this[row, 0], this[row, 1], this[row, 2], this[row, 3]) + "\n";
            return text;
        }
    }
}
