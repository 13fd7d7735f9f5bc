using System;
using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Collektive.Headless.Tests.Engine
{
    /// Tests that physics tolerates scripts that destroy or change bodies at any time.
    public sealed class RobustnessTests : PhysicsFixture
    {
        public class Deactivator : MonoBehaviour
        {
            void OnCollisionEnter(Collision collision) => collision.gameObject.SetActive(false);
            void OnTriggerEnter(Collider other) => other.gameObject.SetActive(false);
        }

        public class SelfDeactivator : MonoBehaviour
        {
            void OnCollisionStay(Collision collision) => gameObject.SetActive(false);
        }

        public class Destroyer : MonoBehaviour
        {
            void OnCollisionEnter(Collision collision) => Object.DestroyImmediate(collision.gameObject);
            void OnTriggerEnter(Collider other) => Object.DestroyImmediate(this);
        }

        public class Changer : MonoBehaviour
        {
            void OnCollisionEnter(Collision collision)
            {
                GetComponent<Collider>().enabled = false;
                GetComponent<Rigidbody>().isKinematic = true;
                transform.localScale = new Vector3(-2f, 2f, 2f);
                gameObject.AddComponent<BoxCollider>().isTrigger = true;
                Physics.SyncTransforms();
                Physics.Raycast(Vector3.up, Vector3.down);
            }
        }

        [TestCase(typeof(Deactivator))]
        [TestCase(typeof(SelfDeactivator))]
        [TestCase(typeof(Changer))]
        public void Collision_messages_can_deactivate_and_change_bodies(Type script)
        {
            Floor();
            for (var index = 0; index < 100; index++)
                Ball(new Vector3(index % 10 * 0.9f, 1f + index / 10 * 0.9f, 0f)).gameObject.AddComponent(script);
            Run(2f);
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_trigger_message_can_deactivate_the_other_object()
        {
            var zone = Box(Vector3.zero, new Vector3(4f, 4f, 4f));
            zone.isTrigger = true;
            zone.gameObject.AddComponent<Deactivator>();
            for (var index = 0; index < 50; index++) Ball(new Vector3(0f, index, 0f), 0.1f);
            Run(4f);
            Assert.That(Object.FindAnyObjectByType<Rigidbody>() == null, Is.True);
            Assert.That(Errors, Is.Empty);
        }

        [TestCase(false)]
        [TestCase(true)]
        public void Physics_messages_cannot_destroy_immediately(bool isTrigger)
        {
            Floor().isTrigger = isTrigger;
            var ball = Ball(new Vector3(0f, 0.5f, 0f));
            var destroyer = ball.gameObject.AddComponent<Destroyer>();
            Run(0.2f);
            Assert.That(Object.FindObjectsByType<Collider>(FindObjectsSortMode.None), Has.Length.EqualTo(2));
            Assert.That(destroyer != null, Is.True);
            Assert.That(Errors[0], Is.EqualTo("DestroyImmediate is not permitted in physics messages, such as OnCollisionEnter: call Destroy."));
        }

        [TestCase(1e30f)]
        [TestCase(float.MaxValue)]
        public void Extreme_forces_keep_positions_finite(float force)
        {
            Floor();
            var ball = Ball(new Vector3(0f, 0.5f, 0f));
            Ball(new Vector3(0.5f, 1.3f, 0f));
            for (var step = 0; step < 20; step++)
            {
                ball.AddForce(force, force, force);
                ball.AddForce(force, -force, force);
                ball.AddTorque(force, force, -force);
                Physics.Simulate(Step);
                var sum = ball.position.x + ball.position.y + ball.position.z;
                Assert.That(sum - sum, Is.EqualTo(0f));
            }
            Physics.Raycast(Vector3.up, Vector3.down);
        }

        [Test]
        public void Calls_on_disabled_and_kinematic_bodies_do_not_fail()
        {
            var ball = Ball(Vector3.zero);
            ball.gameObject.SetActive(false);
            ball.AddForce(Vector3.one);
            ball.linearVelocity = Vector3.one;
            ball.Sleep();
            ball.WakeUp();
            ball.MovePosition(Vector3.one);
            ball.centerOfMass = Vector3.up;
            ball.inertiaTensor = Vector3.one;
            ball.SweepTest(Vector3.right, out _);
            ball.gameObject.SetActive(true);
            ball.isKinematic = true;
            ball.AddForce(Vector3.one);
            ball.AddTorque(Vector3.one);
            ball.Sleep();
            ball.isKinematic = false;
            ball.mass = 0f;
            ball.maxLinearVelocity = float.PositiveInfinity;
            ball.maxAngularVelocity = float.PositiveInfinity;
            ball.solverIterations = 100000;
            Run(0.2f);
            Assert.That(ball.position.y, Is.LessThan(1f));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Queries_with_NaN_find_nothing()
        {
            Box(Vector3.zero, Vector3.one);
            var bad = new Vector3(float.NaN, 0f, 0f);
            Assert.That(Physics.Raycast(bad, Vector3.right), Is.False);
            Assert.That(Physics.Raycast(Vector3.left, bad), Is.False);
            Assert.That(Physics.OverlapSphere(bad, 1f), Is.Empty);
            Assert.That(Physics.OverlapSphere(Vector3.zero, float.NaN), Is.Empty);
            Assert.That(Physics.SphereCast(bad, 1f, Vector3.right, out _), Is.False);
            Assert.That(Physics.CheckBox(Vector3.zero, bad), Is.False);
        }

        [TestCase(3000)]
        [TestCase(100000, Category = "Repeats")]
        public void Too_many_overlapping_bodies_are_an_error(int count)
        {
            for (var index = 0; index < count; index++) Ball(Vector3.zero);
            var error = Assert.Throws<InvalidOperationException>(() => Physics.Simulate(Step));
            Assert.That(error.Message, Is.StringContaining("overlap in one place"));
        }

        [TestCase(-1f, 1f, 1f)]
        [TestCase(-2f, -0.5f, -1f)]
        [TestCase(0f, 1f, 1f)]
        [TestCase(0f, 0f, 0f)]
        [TestCase(1e-6f, 1e-6f, 1e-6f)]
        [TestCase(1e4f, 1e-4f, 1f)]
        public void Bodies_of_any_scale_stay_finite(float x, float y, float z)
        {
            Floor();
            var bodies = new List<Rigidbody>();
            foreach (var type in new[] { PrimitiveType.Cube, PrimitiveType.Sphere, PrimitiveType.Capsule, PrimitiveType.Cylinder })
            {
                var parent = new GameObject("parent");
                parent.transform.position = new Vector3(3f * bodies.Count, 2f, 0f);
                parent.transform.rotation = Quaternion.Euler(10f, 20f, 30f);
                parent.transform.localScale = new Vector3(x, y, z);
                var child = GameObject.CreatePrimitive(type);
                child.transform.SetParent(parent.transform, false);
                child.transform.localRotation = Quaternion.Euler(40f, 50f, 60f);
                bodies.Add(parent.AddComponent<Rigidbody>());
            }
            Run(0.5f);
            foreach (var body in bodies) body.transform.localScale = new Vector3(z, x, -y);
            Run(0.5f);
            foreach (var body in bodies) Assert.That(body.position.magnitude, Is.LessThan(1e4f), "the position must be finite and not far away");
            Physics.OverlapSphere(Vector3.zero, 100f);
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Many_overlapping_bodies_stay_finite()
        {
            var balls = new List<Rigidbody>();
            for (var index = 0; index < 300; index++) balls.Add(Ball(new Vector3(index * 1e-3f, 0f, 0f)));
            Run(1f);
            foreach (var ball in balls) Assert.That(ball.position.magnitude, Is.LessThan(1000f));
        }
    }
}
