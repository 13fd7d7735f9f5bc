using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    /// Tests the behaviour of PhysX: free fall, rest, sleep and fast bodies.
    public sealed class MotionTests : PhysicsFixture
    {
        public class CollisionCounter : MonoBehaviour
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
        public void The_contact_impulse_of_a_resting_body_is_weight_times_step(float mass)
        {
            Floor();
            var box = Box(new Vector3(0f, 0.5f, 0f), Vector3.one).gameObject.AddComponent<Rigidbody>();
            box.mass = mass;
            box.sleepThreshold = 0f;
            var counter = box.gameObject.AddComponent<CollisionCounter>();
            Run(2f);
            Assert.That(counter.Impulse, Is.EqualTo(mass * 9.81f * Step).Within(1f).Percent);
            Assert.That(counter.Enters, Is.EqualTo(1));
            Assert.That(counter.Stays, Is.EqualTo(99), "each step after Enter must send a Stay message");
        }

        [Test]
        public void A_sleeping_body_reports_no_contacts()
        {
            Floor();
            var box = Box(new Vector3(0f, 0.5f, 0f), Vector3.one).gameObject.AddComponent<Rigidbody>();
            var counter = box.gameObject.AddComponent<CollisionCounter>();
            Run(3f);
            Assert.That(box.IsSleeping(), Is.True);
            Assert.That(box.linearVelocity, Is.EqualTo(Vector3.zero));
            var stays = counter.Stays;
            Run(1f);
            Assert.That(counter.Stays, Is.EqualTo(stays));
            Assert.That(counter.Exits, Is.EqualTo(0));
        }

        [Test]
        public void A_collision_wakes_a_sleeping_body()
        {
            Floor(Frictionless());
            var sleeper = Ball(new Vector3(0f, 0.5f, 0f), material: Frictionless());
            Run(3f);
            Assert.That(sleeper.IsSleeping(), Is.True);
            Ball(new Vector3(-3f, 0.5f, 0f), material: Frictionless()).linearVelocity = new Vector3(3f, 0f, 0f);
            Run(1f);
            Assert.That(sleeper.IsSleeping(), Is.False);
            Assert.That(sleeper.position.x, Is.GreaterThan(0.1f));
        }

        [Test]
        public void A_collision_of_equal_balls_conserves_momentum()
        {
            var still = Ball(new Vector3(3f, 0f, 0f), material: Frictionless());
            var moving = Ball(new Vector3(0f, 0f, 0f), material: Frictionless());
            still.useGravity = moving.useGravity = false;
            moving.linearVelocity = new Vector3(4f, 0f, 0f);
            Run(2f);
            Assert.That(still.linearVelocity.x + moving.linearVelocity.x, Is.EqualTo(4f).Within(1e-3f));
            Assert.That(still.linearVelocity.x, Is.GreaterThan(1.9f));
        }

        /// Shoots a bullet at 300 m/s and returns it after 0.2 s. If it hits no body, it is then 49 m past the origin.
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
        public void Continuous_detection_between_bodies_depends_on_both_modes(CollisionDetectionMode mode, CollisionDetectionMode targets, bool passes)
        {
            var target = Box(new Vector3(0f, 0f, 0f), new Vector3(0.05f, 4f, 4f)).gameObject.AddComponent<Rigidbody>();
            target.useGravity = false;
            target.mass = 1000f;
            target.collisionDetectionMode = targets;
            var bullet = Shoot(mode);
            Assert.That(bullet.position.x > 1f, Is.EqualTo(passes), bullet.position.ToString());
        }

        [Test]
        public void A_continuous_body_can_become_kinematic()
        {
            var body = Ball(Vector3.zero);
            body.collisionDetectionMode = CollisionDetectionMode.Continuous;
            body.isKinematic = true;
            Physics.Simulate(Step);
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_body_without_colliders_has_an_inertia_of_1()
        {
            var body = new GameObject().AddComponent<Rigidbody>();
            body.mass = 5f;
            Assert.That(body.inertiaTensor, Is.EqualTo(Vector3.one));
        }

        [Test]
        public void Centre_of_mass_and_inertia_are_computed_from_colliders_unless_set()
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
        public void An_inertia_of_0_locks_the_rotation_about_an_axis()
        {
            var ball = Ball(Vector3.zero);
            foreach (var inertia in new[] { new Vector3(0f, 1f, 1f), Vector3.zero })
            {
                ball.inertiaTensor = inertia;
                ball.AddTorque(Vector3.one, ForceMode.Impulse);
                Physics.Simulate(0.02f);
                Assert.That(ball.angularVelocity.x, Is.EqualTo(0f));
                Assert.That(ball.angularVelocity.y, Is.EqualTo(inertia.y).Within(0.01f));
                Assert.That(ball.inertiaTensor == inertia, Is.True);
                ball.angularVelocity = Vector3.zero;
            }
            Assert.That(Errors, Is.Empty);
            ball.ResetInertiaTensor();
            Assert.That(ball.inertiaTensor.x, Is.EqualTo(0.1f).Within(0.001f));
        }

        [Test]
        public void A_negative_inertia_is_rejected()
        {
            var ball = Ball(Vector3.zero);
            var before = ball.inertiaTensor;
            ball.inertiaTensor = new Vector3(1f, -1f, 1f);
            Assert.That(Errors.Count, Is.EqualTo(1));
            Assert.That(ball.inertiaTensor == before, Is.True);
            Assert.That(ball.automaticInertiaTensor, Is.True);
        }

        [Test]
        public void Bodies_separate_no_faster_than_the_depenetration_velocity()
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
