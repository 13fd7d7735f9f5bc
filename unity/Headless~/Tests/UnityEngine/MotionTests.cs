using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    /// What PhysX does by itself: free fall, rest, sleep, fast bodies.
    public sealed class MotionTests : PhysicsFixture
    {
        public class Feeler : MonoBehaviour
        {
            public float Impulse;
            public int Enters, Stays, Exits;

            void OnCollisionEnter(Collision collision) => Enters++;
            void OnCollisionExit(Collision collision) => Exits++;

            void OnCollisionStay(Collision collision)
            {
                Stays++;
                Impulse = collision.impulse.y;
            }
        }

        [Test]
        public void A_body_of_1_kg_falls_4_905_metres_in_a_second()
        {
            var ball = Ball(new Vector3(0f, 100f, 0f));
            for (var step = 0; step < 100; step++) Physics.Simulate(0.01f);
            Assert.That(100f - ball.position.y, Is.EqualTo(4.905f).Within(1f).Percent);
        }

        [TestCase(1f)]
        [TestCase(20f)]
        public void A_body_rests_with_an_impulse_of_weight_times_time(float mass)
        {
            Floor();
            var box = Box(new Vector3(0f, 0.5f, 0f), Vector3.one).gameObject.AddComponent<Rigidbody>();
            box.mass = mass;
            box.sleepThreshold = 0f;
            var feeler = box.gameObject.AddComponent<Feeler>();
            Run(2f);
            Assert.That(feeler.Impulse, Is.EqualTo(mass * 9.81f * Step).Within(1f).Percent);
            Assert.That(feeler.Enters, Is.EqualTo(1));
            Assert.That(feeler.Stays, Is.EqualTo(99), "from the step after Enter on");
        }

        [Test]
        public void A_body_at_rest_falls_asleep_and_its_contact_is_no_longer_reported()
        {
            Floor();
            var box = Box(new Vector3(0f, 0.5f, 0f), Vector3.one).gameObject.AddComponent<Rigidbody>();
            var feeler = box.gameObject.AddComponent<Feeler>();
            Run(3f);
            Assert.That(box.IsSleeping(), Is.True);
            Assert.That(box.linearVelocity, Is.EqualTo(Vector3.zero));
            var stays = feeler.Stays;
            Run(1f);
            Assert.That(feeler.Stays, Is.EqualTo(stays));
            Assert.That(feeler.Exits, Is.EqualTo(0));
        }

        [Test]
        public void A_body_that_is_hit_wakes_up()
        {
            Floor(Slippery());
            var sleeper = Ball(new Vector3(0f, 0.5f, 0f), material: Slippery());
            Run(3f);
            Assert.That(sleeper.IsSleeping(), Is.True);
            Ball(new Vector3(-3f, 0.5f, 0f), material: Slippery()).linearVelocity = new Vector3(3f, 0f, 0f);
            Run(1f);
            Assert.That(sleeper.IsSleeping(), Is.False);
            Assert.That(sleeper.position.x, Is.GreaterThan(0.1f));
        }

        [Test]
        public void Two_equal_balls_share_their_momentum()
        {
            var still = Ball(new Vector3(3f, 0f, 0f), material: Slippery());
            var moving = Ball(new Vector3(0f, 0f, 0f), material: Slippery());
            still.useGravity = moving.useGravity = false;
            moving.linearVelocity = new Vector3(4f, 0f, 0f);
            Run(2f);
            Assert.That(still.linearVelocity.x + moving.linearVelocity.x, Is.EqualTo(4f).Within(1e-3f));
            Assert.That(still.linearVelocity.x, Is.GreaterThan(1.9f));
        }

        /// A bullet of 300 m/s, 0.2 s later; without a hit it is 49 m behind the origin.
        static Rigidbody Shoot(CollisionDetectionMode mode)
        {
            var bullet = Ball(new Vector3(-11f, 0f, 0f), 0.05f);
            bullet.useGravity = false;
            bullet.collisionDetectionMode = mode;
            bullet.linearVelocity = new Vector3(300f, 0f, 0f);
            Run(0.2f);
            return bullet;
        }

        [TestCase(CollisionDetectionMode.Discrete, true)]
        [TestCase(CollisionDetectionMode.Continuous, false)]
        [TestCase(CollisionDetectionMode.ContinuousDynamic, false)]
        [TestCase(CollisionDetectionMode.ContinuousSpeculative, false)]
        public void A_fast_bullet_passes_a_wall_only_with_discrete_detection(CollisionDetectionMode mode, bool passes)
        {
            Box(new Vector3(0f, 0f, 0f), new Vector3(0.05f, 4f, 4f));
            var bullet = Shoot(mode);
            Assert.That(bullet.position.x > 0f, Is.EqualTo(passes), bullet.position.ToString());
        }

        [TestCase(CollisionDetectionMode.Continuous, CollisionDetectionMode.Continuous, true)]
        [TestCase(CollisionDetectionMode.ContinuousDynamic, CollisionDetectionMode.Continuous, false)]
        [TestCase(CollisionDetectionMode.ContinuousDynamic, CollisionDetectionMode.Discrete, true)]
        public void A_bullet_is_swept_against_bodies_only_as_their_modes_say(CollisionDetectionMode mode, CollisionDetectionMode targets, bool passes)
        {
            var target = Box(new Vector3(0f, 0f, 0f), new Vector3(0.05f, 4f, 4f)).gameObject.AddComponent<Rigidbody>();
            target.useGravity = false;
            target.mass = 1000f;
            target.collisionDetectionMode = targets;
            var bullet = Shoot(mode);
            Assert.That(bullet.position.x > 1f, Is.EqualTo(passes), bullet.position.ToString());
        }

        [Test]
        public void Mass_centre_and_inertia_come_from_the_colliders_unless_set()
        {
            var box = Box(Vector3.zero, new Vector3(1f, 2f, 3f)).gameObject.AddComponent<Rigidbody>();
            box.mass = 12f;
            var expected = new Vector3(4f + 9f, 1f + 9f, 1f + 4f); // m / 12 (b2 + c2)
            var found = box.inertiaTensor;
            var sorted = new List<float> { found.x, found.y, found.z };
            sorted.Sort();
            Assert.That(sorted[0], Is.EqualTo(expected.z).Within(0.01f));
            Assert.That(sorted[1], Is.EqualTo(expected.y).Within(0.01f));
            Assert.That(sorted[2], Is.EqualTo(expected.x).Within(0.01f));
            box.centerOfMass = new Vector3(0f, -0.5f, 0f);
            Assert.That(box.worldCenterOfMass == new Vector3(0f, -0.5f, 0f), Is.True);
            box.ResetCenterOfMass();
            Assert.That(box.centerOfMass == Vector3.zero, Is.True);
        }

        [Test]
        public void Deep_overlaps_come_apart_no_faster_than_the_depenetration_velocity()
        {
            Ball(Vector3.zero).useGravity = false;
            var ball = Ball(new Vector3(0.1f, 0f, 0f));
            ball.useGravity = false;
            ball.maxDepenetrationVelocity = 1f;
            Physics.Simulate(Step);
            Assert.That(ball.linearVelocity.magnitude, Is.LessThanOrEqualTo(1.001f));
        }
    }
}
