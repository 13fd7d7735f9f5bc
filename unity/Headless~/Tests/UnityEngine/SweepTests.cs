using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    /// Tests queries with shapes: sweeps, overlaps and penetration.
    public sealed class SweepTests : PhysicsFixture
    {
        const float Gap = 1e-4f;

        static BoxCollider Wall()
        {
            var wall = Box(new Vector3(10f, 0f, 0f), new Vector3(2f, 20f, 20f)); // its near side at x = 9
            Physics.SyncTransforms();
            return wall;
        }

        [Test]
        public void A_sphere_cast_stops_a_radius_before_the_wall()
        {
            var wall = Wall();
            Assert.That(Physics.SphereCast(Vector3.zero, 1f, Vector3.right, out var hit), Is.True);
            Assert.That(hit.collider, Is.SameAs(wall));
            Assert.That(hit.distance, Is.EqualTo(8f).Within(1e-4f));
            Assert.That(hit.point == new Vector3(9f, 0f, 0f) && hit.normal == Vector3.left, Is.True);
            Assert.That(Physics.SphereCast(new Ray(Vector3.zero, Vector3.right), 1f, 7.9f), Is.False);
            Assert.That(Physics.SphereCast(Vector3.zero, 1f, Vector3.left, out _), Is.False);
        }

        [Test]
        public void A_cast_ignores_colliders_that_contain_its_start()
        {
            Wall();
            Assert.That(Physics.SphereCast(new Vector3(8.5f, 0f, 0f), 1f, Vector3.right, out _), Is.False);
        }

        [Test]
        public void Casts_for_all_hits_include_colliders_that_contain_their_start()
        {
            var wall = Wall();
            var ball = Box(new Vector3(20f, 0f, 0f), Vector3.one);
            Physics.SyncTransforms();
            var one = new RaycastHit[1];
            Assert.That(Physics.SphereCastNonAlloc(new Vector3(8.5f, 0f, 0f), 1f, Vector3.right, one, 5f), Is.EqualTo(1));
            var all = Physics.SphereCastAll(new Vector3(8.5f, 0f, 0f), 1f, Vector3.right);
            System.Array.Sort(all, (a, b) => a.distance.CompareTo(b.distance));
            Assert.That(System.Array.ConvertAll(all, hit => hit.collider), Is.EqualTo(new[] { wall, ball }));
            foreach (var hit in new[] { one[0], all[0] })
                Assert.That((hit.distance, hit.point, hit.normal), Is.EqualTo((0f, Vector3.zero, Vector3.left)));
        }

        [Test]
        public void A_cast_of_length_0_finds_colliders_that_contain_its_start()
        {
            var wall = Wall();
            Assert.That(Physics.SphereCastAll(new Vector3(8.5f, 0f, 0f), 1f, Vector3.up, 0f)[0].collider, Is.SameAs(wall));
            Assert.That(Physics.SphereCastAll(new Vector3(7f, 0f, 0f), 1f, Vector3.up, 0f), Is.Empty);
            Assert.That(Physics.SphereCast(new Vector3(8.5f, 0f, 0f), 1f, Vector3.up, out _, 0f), Is.False);
        }

        [Test]
        public void Box_and_capsule_casts_stop_at_their_surfaces()
        {
            Wall();
            Assert.That(Physics.BoxCast(Vector3.zero, new Vector3(2f, 1f, 1f), Vector3.right, out var hit), Is.True);
            Assert.That(hit.distance, Is.EqualTo(7f).Within(Gap));
            Assert.That(Physics.BoxCast(Vector3.zero, new Vector3(1f, 1f, 1f), Vector3.right, out hit, Quaternion.Euler(0f, 45f, 0f)), Is.True);
            Assert.That(hit.distance, Is.EqualTo(9f - Mathf.Sqrt(2f)).Within(Gap));
            Assert.That(Physics.CapsuleCast(new Vector3(0f, -2f, 0f), new Vector3(0f, 2f, 0f), 0.5f, Vector3.right, out hit), Is.True);
            Assert.That(hit.distance, Is.EqualTo(8.5f).Within(Gap));
            Assert.That(Physics.CapsuleCast(new Vector3(-2f, 0f, 0f), new Vector3(2f, 0f, 0f), 0.5f, Vector3.right, out hit), Is.True);
            Assert.That(hit.distance, Is.EqualTo(6.5f).Within(Gap));
        }

        [Test]
        public void Casts_return_all_hits_up_to_the_buffer_size()
        {
            for (var index = 1; index <= 20; index++) Box(new Vector3(index * 3f, 0f, 0f), Vector3.one);
            Physics.SyncTransforms();
            Assert.That(Physics.SphereCastAll(Vector3.zero, 0.5f, Vector3.right).Length, Is.EqualTo(20));
            Assert.That(Physics.RaycastAll(Vector3.zero, Vector3.right, 10f).Length, Is.EqualTo(3));
            Assert.That(Physics.SphereCastNonAlloc(Vector3.zero, 0.5f, Vector3.right, new RaycastHit[4]), Is.EqualTo(4));
        }

        [Test]
        public void Box_and_capsule_overlaps_find_touching_colliders()
        {
            var wall = Wall();
            Assert.That(Physics.OverlapBox(new Vector3(8f, 0f, 0f), new Vector3(1.1f, 1f, 1f)), Is.EqualTo(new[] { wall }));
            Assert.That(Physics.CheckBox(new Vector3(8f, 0f, 0f), new Vector3(0.9f, 1f, 1f)), Is.False);
            Assert.That(Physics.CheckBox(new Vector3(8f, 0f, 0f), new Vector3(0.9f, 0.9f, 0.9f), Quaternion.Euler(0f, 45f, 0f)), Is.True);
            Assert.That(Physics.OverlapCapsule(new Vector3(5f, 0f, 0f), new Vector3(8.6f, 0f, 0f), 0.5f).Length, Is.EqualTo(1));
            Assert.That(Physics.CheckCapsule(new Vector3(5f, 0f, 0f), new Vector3(8.4f, 0f, 0f), 0.5f), Is.False);
        }

        [Test]
        public void ComputePenetration_returns_the_shortest_way_out()
        {
            var wall = Wall();
            var ball = new GameObject("ball").AddComponent<SphereCollider>();
            Assert.That(Physics.ComputePenetration(ball, new Vector3(8.8f, 0f, 0f), Quaternion.identity, wall, wall.transform.position, Quaternion.identity,
                out var direction, out var distance), Is.True);
            Assert.That(direction == Vector3.left, Is.True);
            Assert.That(distance, Is.EqualTo(0.3f).Within(1e-3f));
            Assert.That(Physics.ComputePenetration(ball, new Vector3(8.4f, 0f, 0f), Quaternion.identity, wall, wall.transform.position, Quaternion.identity,
                out _, out _), Is.False);
        }

        [Test]
        public void SweepTest_uses_all_colliders_and_ignores_the_body_itself()
        {
            var wall = Wall();
            var body = Ball(Vector3.zero);
            var arm = new GameObject("arm").AddComponent<BoxCollider>();
            arm.transform.SetParent(body.transform, false);
            arm.transform.localPosition = new Vector3(2f, 0f, 0f);
            Physics.SyncTransforms();
            Assert.That(body.SweepTest(Vector3.right, out var hit), Is.True);
            Assert.That(hit.collider, Is.SameAs(wall));
            Assert.That(hit.distance, Is.EqualTo(6.5f).Within(Gap));
            Assert.That(body.SweepTest(Vector3.right, out _, 6f), Is.False);
            Assert.That(body.SweepTestAll(Vector3.right).Length, Is.EqualTo(2), "each collider must have a hit");
        }

        [TestCase(-1f, 1f, 1f)]
        [TestCase(0f, 0f, 0f)]
        [TestCase(1e-9f, 1f, -3f)]
        public void Mirrored_and_flat_colliders_can_be_queried_and_simulated(float x, float y, float z)
        {
            foreach (var type in new[] { PrimitiveType.Cube, PrimitiveType.Sphere, PrimitiveType.Capsule, PrimitiveType.Cylinder })
            {
                var thing = GameObject.CreatePrimitive(type);
                thing.transform.localScale = new Vector3(x, y, z);
                thing.AddComponent<Rigidbody>();
            }
            Run(0.1f);
            Assert.That(Errors, Is.Empty);
            Assert.That(Physics.OverlapSphere(Vector3.zero, 10f).Length, Is.EqualTo(4));
        }
    }
}
