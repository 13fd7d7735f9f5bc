using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class JointTests : PhysicsFixture
    {
        [Test]
        public void A_joint_of_a_copy_connects_the_copied_bodies()
        {
            var template = Ball(Vector3.zero);
            var arm = Ball(new Vector3(0f, -2f, 0f));
            arm.transform.SetParent(template.transform);
            arm.gameObject.AddComponent<FixedJoint>().connectedBody = template;
            template.useGravity = arm.useGravity = false;

            var copy = Object.Instantiate(template, new Vector3(10f, 0f, 0f), Quaternion.identity);
            copy.linearVelocity = new Vector3(1f, 0f, 0f);
            Run(1f);

            var joint = copy.GetComponentInChildren<FixedJoint>();
            Assert.That(joint.connectedBody, Is.SameAs(copy));
            Assert.That((joint.transform.position - copy.position).magnitude, Is.EqualTo(2f).Within(0.01f));
            Assert.That(template.position, Is.EqualTo(Vector3.zero));
        }

        public class Breaker : MonoBehaviour
        {
            void OnJointBreak(float force) => Notes.Add("breaks at " + force.ToString("0"));
        }

        [Test]
        public void A_joint_connects_bodies_where_their_transforms_are()
        {
            var parent = new GameObject("parent");
            var a = Ball(Vector3.zero);
            var b = Ball(Vector3.up);
            a.transform.SetParent(parent.transform);
            a.useGravity = b.useGravity = false;
            Physics.SyncTransforms();
            parent.transform.position = new Vector3(5f, 0f, 0f);
            b.transform.position = new Vector3(7f, 0f, 0f);
            a.gameObject.AddComponent<FixedJoint>().connectedBody = b;
            b.gameObject.AddComponent<HingeJoint>();
            Run(0.5f);
            Assert.That((a.position - new Vector3(5f, 0f, 0f)).magnitude, Is.LessThan(1e-3f));
            Assert.That((b.position - new Vector3(7f, 0f, 0f)).magnitude, Is.LessThan(1e-3f));
        }

        [Test]
        public void A_joint_connects_a_body_where_a_script_set_it_before_its_scale()
        {
            var ball = Ball(Vector3.zero);
            ball.useGravity = false;
            ball.position = new Vector3(5f, 0f, 0f);
            ball.transform.localScale = new Vector3(2f, 2f, 2f);
            ball.gameObject.AddComponent<FixedJoint>();
            Run(0.5f);
            Assert.That(ball.position.x, Is.EqualTo(5f).Within(1e-3f));
        }

        [Test]
        public void A_fixed_joint_holds_a_body_in_the_world()
        {
            var ball = Ball(new Vector3(0f, 5f, 0f));
            ball.gameObject.AddComponent<FixedJoint>();
            Run(1f);
            Assert.That((ball.position - new Vector3(0f, 5f, 0f)).magnitude, Is.LessThan(0.01f));
        }

        [Test]
        public void Two_bodies_with_a_fixed_joint_fall_as_one()
        {
            var a = Ball(new Vector3(-1f, 5f, 0f));
            var b = Ball(new Vector3(1f, 5f, 0f));
            a.gameObject.AddComponent<FixedJoint>().connectedBody = b;
            a.AddForce(new Vector3(0f, 0f, 3f), ForceMode.Impulse);
            Run(0.5f);
            Assert.That((a.position - b.position).magnitude, Is.EqualTo(2f).Within(0.01f));
            Assert.That(b.angularVelocity.y, Is.Not.EqualTo(0f));
        }

        [Test]
        public void A_hinge_swings_about_its_anchor()
        {
            var ball = Ball(new Vector3(2f, 5f, 0f));
            var hinge = ball.gameObject.AddComponent<HingeJoint>();
            hinge.axis = Vector3.forward;
            hinge.anchor = new Vector3(-2f, 0f, 0f);
            var lowest = 5f;
            for (var step = 0; step < 100; step++)
            {
                Physics.Simulate(Step);
                Assert.That((ball.position - new Vector3(0f, 5f, 0f)).magnitude, Is.EqualTo(2f).Within(0.02f));
                lowest = Mathf.Min(lowest, ball.position.y);
            }
            Assert.That(lowest, Is.EqualTo(3f).Within(0.05f));
        }

        [Test]
        public void A_motor_turns_a_hinge_at_its_velocity()
        {
            var ball = Ball(Vector3.zero);
            var hinge = VerticalHinge(ball);
            hinge.motor = new JointMotor { targetVelocity = 90f, force = 100f };
            hinge.useMotor = true;
            Run(1f);
            Assert.That(hinge.velocity, Is.EqualTo(90f).Within(1f));
            Assert.That(ball.angularVelocity.y, Is.EqualTo(Mathf.PI / 2f).Within(0.02f));
        }

        [TestCase(45f)]
        [TestCase(-20f)]
        public void A_spring_turns_a_hinge_to_its_target(float target)
        {
            var ball = Ball(Vector3.zero);
            var hinge = VerticalHinge(ball);
            hinge.spring = new JointSpring { spring = 10f, damper = 2f, targetPosition = target };
            hinge.useSpring = true;
            Run(4f);
            Assert.That(Quaternion.Angle(ball.rotation, Quaternion.Euler(0f, target, 0f)), Is.LessThan(2f));
        }

        [Test]
        public void Limits_stop_a_hinge()
        {
            var ball = Ball(Vector3.zero);
            var hinge = VerticalHinge(ball);
            hinge.limits = new JointLimits { min = -10f, max = 30f };
            hinge.useLimits = true;
            ball.AddTorque(new Vector3(0f, 1f, 0f), ForceMode.VelocityChange);
            Run(2f);
            Assert.That(Quaternion.Angle(ball.rotation, Quaternion.Euler(0f, 30f, 0f)), Is.LessThan(2f));
        }

        [TestCase(0f)]
        [TestCase(30f)]
        public void Equal_limits_lock_a_hinge_at_their_angle(float angle)
        {
            var ball = Ball(Vector3.zero);
            var hinge = VerticalHinge(ball);
            hinge.limits = new JointLimits { min = angle, max = angle };
            hinge.useLimits = true;
            ball.AddTorque(new Vector3(0f, 1f, 0f), ForceMode.VelocityChange);
            Run(2f);
            Assert.That(Quaternion.Angle(ball.rotation, Quaternion.Euler(0f, angle, 0f)), Is.LessThan(1f));
        }

        [Test]
        public void Limits_with_min_above_max_are_an_error()
        {
            var hinge = VerticalHinge(Ball(Vector3.zero));
            hinge.limits = new JointLimits { min = 30f, max = -10f };
            hinge.useLimits = true;
            Run(1f);
            Assert.That(Errors, Is.EqualTo(new[] { "HingeJoint 'ball' has no limits, because min (30) exceeds max (-10)." }));
        }

        [Test]
        public void Limits_stop_a_hinge_whose_motor_is_set_in_each_step()
        {
            var ball = Ball(Vector3.zero);
            var hinge = VerticalHinge(ball);
            hinge.limits = new JointLimits { min = -10f, max = 30f };
            hinge.useLimits = hinge.useMotor = true;
            foreach (var (velocity, limit) in new[] { (90f, 30f), (-90f, -10f) })
            {
                for (var step = 0; step < 100; step++)
                {
                    hinge.motor = new JointMotor { targetVelocity = velocity, force = 1f };
                    Physics.Simulate(Step);
                }
                Assert.That(Quaternion.Angle(ball.rotation, Quaternion.Euler(0f, limit, 0f)), Is.LessThan(2f));
            }
        }

        [Test]
        public void Another_strength_of_a_spring_keeps_its_anchors()
        {
            var ball = Ball(new Vector3(0f, 5f, 0f));
            var joint = ball.gameObject.AddComponent<SpringJoint>();
            joint.damper = 5f;
            Run(6f);
            joint.spring = 20f;
            ball.WakeUp();
            Run(6f);
            Assert.That(joint.connectedAnchor, Is.EqualTo(new Vector3(0f, 5f, 0f)));
            Assert.That(5f - ball.position.y, Is.EqualTo(9.81f / 20f).Within(0.05f));
        }

        [Test]
        public void A_spring_holds_a_weight_at_equilibrium()
        {
            var ball = Ball(new Vector3(0f, 5f, 0f));
            var joint = ball.gameObject.AddComponent<SpringJoint>();
            joint.spring = 20f;
            joint.damper = 5f;
            Run(6f);
            Assert.That(5f - ball.position.y, Is.EqualTo(9.81f / 20f).Within(0.05f));
        }

        [Test]
        public void A_joint_breaks_above_its_break_force_and_sends_OnJointBreak()
        {
            var ball = Ball(new Vector3(0f, 5f, 0f));
            ball.gameObject.AddComponent<Breaker>();
            ball.gameObject.AddComponent<FixedJoint>().breakForce = 50f;
            Run(0.5f);
            Assert.That(Notes, Is.Empty);
            ball.AddForce(100f, 0f, 0f);
            Run(0.5f);
            Assert.That(Events(), Is.EqualTo("breaks at 100"));
            Assert.That(ball.position.y, Is.LessThan(4.5f));
            UnityEngine.Headless.Loop.Frame(0.02f);
            Assert.That(ball.GetComponent<Joint>() == null, Is.True);
        }

        [Test]
        public void Bodies_collide_unless_a_joint_connects_them()
        {
            var a = Ball(Vector3.zero);
            var b = Ball(new Vector3(0.9f, 0f, 0f));
            a.useGravity = b.useGravity = false;
            Physics.Simulate(Step);
            a.position = Vector3.zero;
            b.position = new Vector3(0.9f, 0f, 0f);
            a.linearVelocity = b.linearVelocity = Vector3.zero;
            var joint = a.gameObject.AddComponent<SpringJoint>();
            joint.connectedBody = b;
            joint.spring = joint.damper = 0f;
            Run(0.2f);
            Assert.That(b.position.x - a.position.x, Is.EqualTo(0.9f).Within(1e-3f), "the joint disables collisions");
            joint.enableCollision = true;
            Physics.Simulate(Step);
            Assert.That(b.position.x - a.position.x, Is.GreaterThan(0.91f), "collisions are enabled");
            joint.enableCollision = false;
            a.position = Vector3.zero;
            b.position = new Vector3(0.9f, 0f, 0f);
            a.linearVelocity = b.linearVelocity = Vector3.zero;
            Run(0.2f);
            Assert.That(b.position.x - a.position.x, Is.EqualTo(0.9f).Within(1e-3f), "collisions are disabled");
            Object.DestroyImmediate(joint);
            Physics.Simulate(Step);
            Assert.That(b.position.x - a.position.x, Is.GreaterThan(0.91f), "the joint is destroyed");
        }

        [Test]
        public void A_joint_tolerates_disabled_and_destroyed_bodies()
        {
            var a = Ball(new Vector3(0f, 5f, 0f));
            var b = Ball(new Vector3(2f, 5f, 0f));
            a.gameObject.AddComponent<FixedJoint>().connectedBody = b;
            b.gameObject.SetActive(false);
            Run(0.1f);
            b.gameObject.SetActive(true);
            Run(0.1f);
            Object.DestroyImmediate(b.gameObject);
            Run(0.1f);
            Object.DestroyImmediate(a.gameObject);
            Run(0.1f);
            Assert.That(Errors, Is.Empty);
        }

        /// Adds a hinge about the vertical axis, and switches gravity off.
        static HingeJoint VerticalHinge(Rigidbody ball)
        {
            ball.useGravity = false;
            var hinge = ball.gameObject.AddComponent<HingeJoint>();
            hinge.axis = Vector3.up;
            return hinge;
        }
    }
}
