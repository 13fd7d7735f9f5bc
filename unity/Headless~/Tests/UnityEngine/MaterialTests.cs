using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    /// Tests the friction and the bounce of PhysicsMaterial.
    public sealed class MaterialTests : PhysicsFixture
    {
        [SetUp]
        public void LimitFriction() => Physics.improvedPatchFriction = true;

        /// Returns the distance in metres that a resting box slides in two seconds. Gravity tilts during the first second.
        static float SlideDistance(float degrees, PhysicsMaterial floor, PhysicsMaterial box)
        {
            Floor(floor);
            var body = Box(new Vector3(0f, 0.5f, 0f), Vector3.one, box).gameObject.AddComponent<Rigidbody>();
            body.sleepThreshold = 0f;
            Run(0.5f);
            var start = body.position;
            var down = Physics.gravity;
            for (var step = 1; step <= 100; step++)
            {
                Physics.gravity = Quaternion.Euler(0f, 0f, degrees * Mathf.Min(1f, step / 50f)) * down;
                Physics.Simulate(Step);
            }
            return (body.position - start).magnitude;
        }

        static PhysicsMaterial WithFriction(float friction, PhysicsMaterialCombine combine = PhysicsMaterialCombine.Average) =>
            new PhysicsMaterial { staticFriction = friction, dynamicFriction = friction, frictionCombine = combine };

        [TestCase(26f, false)] // tan 26 = 0.49
        [TestCase(36f, true)] // tan 36 = 0.73
        public void A_box_slides_on_a_slope_above_its_friction_angle_and_rests_below(float degrees, bool slides)
        {
            var distance = SlideDistance(degrees, null, null); // both have the default friction, 0.6
            if (slides) Assert.That(distance, Is.GreaterThan(0.5f));
            else Assert.That(distance, Is.LessThan(0.01f));
        }

        [Test]
        public void Static_friction_holds_a_box_that_dynamic_friction_would_not()
        {
            var material = new PhysicsMaterial { staticFriction = 0.9f, dynamicFriction = 0.1f };
            Assert.That(SlideDistance(35f, material, material), Is.LessThan(0.01f)); // tan 35 = 0.70
        }

        [Test]
        public void A_sliding_box_is_slowed_by_dynamic_friction()
        {
            var material = new PhysicsMaterial { staticFriction = 0.2f, dynamicFriction = 0.2f };
            Floor(material);
            var box = Box(new Vector3(0f, 0.5f, 0f), Vector3.one, material).gameObject.AddComponent<Rigidbody>();
            Run(0.2f);
            box.linearVelocity = new Vector3(5f, 0f, 0f);
            Run(1f);
            Assert.That(box.linearVelocity.x, Is.EqualTo(5f - 0.2f * 9.81f).Within(0.1f));
        }

        [Test]
        public void Friction_of_a_box_is_twice_as_strong_without_the_improved_mode()
        {
            Floor();
            var box = Box(new Vector3(0f, 0.5f, 0f), Vector3.one).gameObject.AddComponent<Rigidbody>();
            box.constraints = RigidbodyConstraints.FreezeRotation;
            Physics.improvedPatchFriction = false;
            box.linearVelocity = new Vector3(5f, 0f, 0f);
            Run(0.2f);
            var speed = box.linearVelocity.x;
            Run(0.1f);
            Assert.That(speed - box.linearVelocity.x, Is.EqualTo(2f * 0.6f * 9.81f * 0.1f).Within(0.01f));
            Physics.improvedPatchFriction = true;
            speed = box.linearVelocity.x;
            Run(0.1f);
            Assert.That(speed - box.linearVelocity.x, Is.EqualTo(0.6f * 9.81f * 0.1f).Within(0.01f));
        }

        [TestCase(PhysicsMaterialCombine.Average, PhysicsMaterialCombine.Average, 0.5f)]
        [TestCase(PhysicsMaterialCombine.Minimum, PhysicsMaterialCombine.Average, 0.2f)]
        [TestCase(PhysicsMaterialCombine.Multiply, PhysicsMaterialCombine.Minimum, 0.16f)]
        [TestCase(PhysicsMaterialCombine.Multiply, PhysicsMaterialCombine.Maximum, 0.8f)]
        public void Friction_is_combined_by_the_mode_of_higher_priority(PhysicsMaterialCombine floor, PhysicsMaterialCombine box, float friction)
        {
            Floor(WithFriction(0.2f, floor));
            var body = Box(new Vector3(0f, 0.5f, 0f), Vector3.one, WithFriction(0.8f, box)).gameObject.AddComponent<Rigidbody>();
            Run(0.2f);
            body.linearVelocity = new Vector3(9f, 0f, 0f);
            Run(0.5f);
            Assert.That(body.linearVelocity.x, Is.EqualTo(9f - friction * 9.81f * 0.5f).Within(0.15f));
        }

        [TestCase(0.5f)]
        [TestCase(0.9f)]
        public void Bounce_height_is_drop_height_times_bounciness_squared(float bounciness)
        {
            var material = new PhysicsMaterial { bounciness = bounciness };
            Floor(material);
            var ball = Ball(new Vector3(0f, 5.5f, 0f), material: material);
            ball.angularDamping = 0f;
            while (ball.linearVelocity.y <= 0f) Physics.Simulate(0.005f);
            var highest = 0f;
            while (ball.linearVelocity.y > 0f)
            {
                Physics.Simulate(0.005f);
                highest = Mathf.Max(highest, ball.position.y - 0.5f);
            }
            Assert.That(highest, Is.EqualTo(5f * bounciness * bounciness).Within(0.2f));
        }

        [Test]
        public void A_ball_below_the_bounce_threshold_of_2_metres_per_second_does_not_bounce()
        {
            var material = new PhysicsMaterial { bounciness = 1f };
            Floor(material);
            var ball = Ball(new Vector3(0f, 0.6f, 0f), material: material); // falls at 1.4 m/s
            Run(1f);
            Assert.That(ball.position.y, Is.EqualTo(0.5f).Within(0.01f));
        }

        [Test]
        public void Colliders_with_the_same_material_have_their_own_copies()
        {
            var rubber = new PhysicsMaterial("rubber");
            Collider a = Floor(), b = Floor();
            a.material = b.material = rubber;
            Assert.That(a.sharedMaterial, Is.SameAs(rubber));
            a.material.bounciness = 1f;
            Assert.That(a.material, Is.SameAs(a.material));
            Assert.That(a.sharedMaterial, Is.SameAs(a.material));
            Assert.That(a.material.name, Is.EqualTo("rubber (Instance)"));
            Assert.That(b.material.bounciness, Is.EqualTo(0f));
            a.material = a.material;
            Assert.That(a.material.name, Is.EqualTo("rubber (Instance)"));
        }

        [Test]
        public void A_changed_material_takes_effect_at_the_next_step()
        {
            var material = WithFriction(0.8f);
            Floor(material);
            var box = Box(new Vector3(0f, 0.5f, 0f), Vector3.one, material).gameObject.AddComponent<Rigidbody>();
            Run(0.2f);
            material.staticFriction = material.dynamicFriction = 0f;
            box.linearVelocity = new Vector3(5f, 0f, 0f);
            Run(1f);
            Assert.That(box.linearVelocity.x, Is.EqualTo(5f).Within(0.01f));
        }
    }
}
