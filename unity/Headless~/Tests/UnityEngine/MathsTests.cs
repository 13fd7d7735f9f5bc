using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class MathsTests
    {
        static void Near(Vector3 actual, Vector3 expected) => Assert.That((actual - expected).magnitude, Is.LessThan(1e-4f), $"{actual} is not {expected}");

        [Test]
        public void NextPowerOfTwo_ends_above_the_largest_power()
        {
            Assert.That(Mathf.NextPowerOfTwo(0), Is.EqualTo(0));
            Assert.That(Mathf.NextPowerOfTwo(5), Is.EqualTo(8));
            Assert.That(Mathf.NextPowerOfTwo(1 << 30), Is.EqualTo(1 << 30));
            Assert.That(Mathf.NextPowerOfTwo((1 << 30) + 1), Is.EqualTo(int.MinValue));
        }

        [Test]
        public void Interpolated_strings_round_like_ToString()
        {
            var vector = new Vector3(1.2345f, 2f, -3f);
            Assert.That($"{vector} {(Vector2)vector}", Is.EqualTo("(1.23, 2.00, -3.00) (1.23, 2.00)"));
            Assert.That($"{Quaternion.identity} {Color.red}", Is.EqualTo("(0.00000, 0.00000, 0.00000, 1.00000) RGBA(1.000, 0.000, 0.000, 1.000)"));
            Assert.That(new Bounds(Vector3.zero, Vector3.one).ToString(), Is.EqualTo("Center: (0.00, 0.00, 0.00), Extents: (0.50, 0.50, 0.50)"));
            Assert.That($"{vector:F1}", Is.EqualTo("(1.2, 2.0, -3.0)"));
            Assert.That($"{new Bounds(vector, Vector3.one):F1}", Is.EqualTo("Center: (1.2, 2.0, -3.0), Extents: (0.5, 0.5, 0.5)"));
            Assert.That($"{new Ray(vector, Vector3.up):F1}", Is.EqualTo("Origin: (1.2, 2.0, -3.0), Dir: (0.0, 1.0, 0.0)"));
        }

        [Test]
        public void Rotations_are_left_handed()
        {
            Near(Quaternion.Euler(0f, 90f, 0f) * Vector3.forward, Vector3.right);
            Near(Quaternion.Euler(90f, 0f, 0f) * Vector3.forward, Vector3.down);
            Near(Quaternion.Euler(0f, 0f, 90f) * Vector3.right, Vector3.up);
            Near(Vector3.Cross(Vector3.right, Vector3.up), Vector3.forward);
        }

        [Test]
        public void Euler_rotates_about_z_then_x_then_y()
        {
            // Unity rotates about z, x and y in this order. The vector (1, 0, 0) becomes up, then forward, and then right.
            Near(Quaternion.Euler(90f, 90f, 90f) * Vector3.right, Vector3.right);
            var half = Mathf.Sqrt(0.5f);
            var q = Quaternion.Euler(0f, 90f, 0f);
            Assert.That(q.y, Is.EqualTo(half).Within(1e-6f));
            Assert.That(q.w, Is.EqualTo(half).Within(1e-6f));
        }

        [Test]
        public void Euler_angles_round_trip()
        {
            var random = new System.Random(7);
            for (var trial = 0; trial < 500; trial++)
            {
                var q = Quaternion.Euler(random.Next(-180, 180), random.Next(-180, 180), random.Next(-180, 180));
                Assert.That(Quaternion.Angle(Quaternion.Euler(q.eulerAngles), q), Is.LessThan(0.2f));
            }
            Near(Quaternion.Euler(10f, 20f, 30f).eulerAngles, new Vector3(10f, 20f, 30f));
            Near(Quaternion.Euler(-10f, 0f, 0f).eulerAngles, new Vector3(350f, 0f, 0f));
        }

        [Test]
        public void LookRotation_Slerp_and_Inverse_match_known_values()
        {
            Near(Quaternion.LookRotation(Vector3.right) * Vector3.forward, Vector3.right);
            Near(Quaternion.LookRotation(new Vector3(1f, 1f, 0f)) * Vector3.forward, new Vector3(1f, 1f, 0f).normalized);
            Assert.That(Quaternion.Slerp(Quaternion.identity, Quaternion.Euler(0f, 90f, 0f), 0.5f) == Quaternion.Euler(0f, 45f, 0f), Is.True);
            Assert.That(Quaternion.Angle(Quaternion.identity, Quaternion.Euler(0f, 30f, 0f)), Is.EqualTo(30f).Within(1e-2f));
            var turn = Quaternion.Euler(13f, 57f, 101f);
            Assert.That(turn * Quaternion.Inverse(turn) == Quaternion.identity, Is.True);
            Near(Quaternion.FromToRotation(Vector3.up, Vector3.right) * Vector3.up, Vector3.right);
            Near(Quaternion.FromToRotation(Vector3.up, Vector3.down) * Vector3.up, Vector3.down);
        }

        [Test]
        public void A_rotation_to_the_opposite_direction_is_about_x_or_y()
        {
            Near(Quaternion.FromToRotation(Vector3.up, Vector3.down) * Vector3.right, Vector3.right);
            Near(Quaternion.FromToRotation(Vector3.right, Vector3.left) * Vector3.up, Vector3.up);
            Near(Quaternion.FromToRotation(Vector3.forward, Vector3.back) * Vector3.right, Vector3.right);
        }

        [Test]
        public void The_equality_operator_has_a_tolerance_and_Equals_has_none()
        {
            Vector3 a = new Vector3(1f, 0f, 0f), b = new Vector3(1.000001f, 0f, 0f);
            Assert.That(a == b, Is.True);
            Assert.That(a.Equals(b), Is.False);
            Assert.That(a == new Vector3(1.0001f, 0f, 0f), Is.False);
        }

        [Test]
        public void Bounds_with_negative_extents_contain_no_points()
        {
            var bounds = new Bounds(Vector3.zero, -2f * Vector3.one);
            Assert.That(bounds.Contains(bounds.min) || bounds.Contains(bounds.max) || bounds.Contains(Vector3.zero), Is.False);
            bounds.Encapsulate(new Bounds(Vector3.zero, -4f * Vector3.one));
            Assert.That(bounds.Contains(new Vector3(2f, -2f, 0f)));
            Assert.That(bounds.Contains(new Vector3(2.1f, 0f, 0f)), Is.False);
        }

        [Test]
        public void Vector_functions_match_known_values()
        {
            Assert.That(new Vector3(3f, 4f, 0f).magnitude, Is.EqualTo(5f));
            Near(new Vector3(3f, 4f, 0f).normalized, new Vector3(0.6f, 0.8f, 0f));
            Near(Vector3.zero.normalized, Vector3.zero);
            Near(Vector3.ClampMagnitude(new Vector3(6f, 8f, 0f), 5f), new Vector3(3f, 4f, 0f));
            Near(Vector3.MoveTowards(Vector3.zero, Vector3.right * 3f, 1f), Vector3.right);
            Assert.That(Vector3.Angle(Vector3.right, Vector3.up), Is.EqualTo(90f).Within(1e-4f));
            Assert.That(Vector3.SignedAngle(Vector3.forward, Vector3.right, Vector3.up), Is.EqualTo(90f).Within(1e-4f));
            Assert.That(new Vector3(1f, 2f, 3f).ToString(), Is.EqualTo("(1.00, 2.00, 3.00)"));
            Assert.That($"{new Vector4(1f, 2f, 3f, 4f)}", Is.EqualTo("(1.00, 2.00, 3.00, 4.00)"));
        }

        [Test]
        public void Matrices_multiply_and_invert()
        {
            var matrix = Matrix4x4.TRS(new Vector3(1f, 2f, 3f), Quaternion.Euler(10f, 20f, 30f), new Vector3(1f, 2f, 3f));
            Near((matrix * matrix.inverse).MultiplyPoint(new Vector3(4f, 5f, 6f)), new Vector3(4f, 5f, 6f));
            Near(matrix.lossyScale, new Vector3(1f, 2f, 3f));
            Assert.That(matrix.rotation == Quaternion.Euler(10f, 20f, 30f), Is.True);
        }

        [Test]
        public void Random_is_repeatable_and_within_its_range()
        {
            UnityEngine.Random.InitState(5);
            var first = UnityEngine.Random.value;
            for (var draw = 0; draw < 1000; draw++)
            {
                Assert.That(UnityEngine.Random.Range(-3, 4), Is.InRange(-3, 3));
                Assert.That(UnityEngine.Random.Range(-1f, 1f), Is.InRange(-1f, 1f));
                Assert.That(UnityEngine.Random.insideUnitSphere.magnitude, Is.LessThanOrEqualTo(1.00001f));
            }
            UnityEngine.Random.InitState(5);
            Assert.That(UnityEngine.Random.value, Is.EqualTo(first));
        }

        [Test]
        public void A_random_rotation_has_four_normalised_numbers()
        {
            var state = UnityEngine.Random.state;
            var numbers = new float[4];
            for (var index = 0; index < 4; index++) numbers[index] = UnityEngine.Random.Range(-1f, 1f);
            UnityEngine.Random.state = state;
            Assert.That(UnityEngine.Random.rotation, Is.EqualTo(new Quaternion(numbers[0], numbers[1], numbers[2], numbers[3]).normalized));
        }

        [Test]
        public void HSV_conversions_match_known_values()
        {
            Assert.That(Color.HSVToRGB(1f / 3f, 1f, 1f) == Color.green, Is.True);
            Assert.That(Color.HSVToRGB(2f, 1f, 1f), Is.EqualTo(Color.black));
            Color.RGBToHSV(Color.blue, out var hue, out var saturation, out var value);
            Assert.That(new Vector3(hue, saturation, value) == new Vector3(2f / 3f, 1f, 1f), Is.True);
        }

        [Test]
        public void Euler_angles_just_below_0_stay_near_0() =>
            Assert.That(Quaternion.Euler(0f, -1e-3f, 0f).eulerAngles.y, Is.EqualTo(-1e-3f).Within(1e-5f));

        [Test]
        public void Vectors_and_matrices_with_NaN_are_not_equal_to_themselves()
        {
            var vector = new Vector3(float.NaN, 0f, 0f);
            Assert.That(vector.Equals(vector), Is.False);
            Assert.That(((Vector2)vector).Equals(vector), Is.False);
            Assert.That(((Vector4)vector).Equals(vector), Is.False);
            Matrix4x4 matrix = Matrix4x4.Translate(vector), same = matrix;
            Assert.That(matrix == same, Is.False);
            Assert.That(matrix.Equals(same), Is.False);
        }

        [Test]
        public void Min_and_Max_of_several_values_skip_NaN()
        {
            Assert.That(Mathf.Max(1f, float.NaN, 0.5f, 0.2f), Is.EqualTo(1f));
            Assert.That(Mathf.Min(1f, float.NaN, 2f, 3f), Is.EqualTo(1f));
        }

        [Test]
        public void SmoothStep_ends_at_its_end() => Assert.That(Mathf.SmoothStep(1000f, 0.17f, 1f), Is.EqualTo(0.17f));

        [Test]
        public void Zero_counts_as_a_power_of_two() => Assert.That(Mathf.IsPowerOfTwo(0), Is.True);

        [Test]
        public void Matrices_and_rectangles_have_texts()
        {
            Assert.That($"{Matrix4x4.Translate(new Vector3(0.5f, 0f, 0f))}", Is.EqualTo(
                "1.00000\t0.00000\t0.00000\t0.50000\n0.00000\t1.00000\t0.00000\t0.00000\n0.00000\t0.00000\t1.00000\t0.00000\n"
                + "0.00000\t0.00000\t0.00000\t1.00000\n"));
            Assert.That($"{new Rect(1f, 2f, 3f, 4f)}", Is.EqualTo("(x:1.00, y:2.00, width:3.00, height:4.00)"));
        }
    }
}
