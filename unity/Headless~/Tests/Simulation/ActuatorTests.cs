using System;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using probe;
using UnityEngine;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests the effects of the ready-made actuators. The program doubles the sensed value.</summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class ActuatorTests : SimulationFixture
    {
        [Test]
        public void A_node_without_a_body_moves_to_its_target_within_the_speed_limit()
        {
            var node = MakeNode(5).Node;
            var move = node.gameObject.AddComponent<Move>();
            move.MaxSpeed = 4;
            move.ReachTime = 0;
            Play(1);
            Assert.That(node.transform.position.x, Is.EqualTo(0.2f).Within(1e-6f));
            Play(60);
            Assert.That(node.transform.position.x, Is.EqualTo(10).Within(1e-4f), "the node must stop at its target");
        }

        [Test]
        public void A_node_slows_down_near_its_target()
        {
            var node = MakeNode(0.5f).Node;
            var move = node.gameObject.AddComponent<Move>();
            move.MaxSpeed = 4;
            move.ReachTime = 1;
            Play(1);
            Assert.That(node.transform.position.x, Is.EqualTo(0.05f).Within(1e-6f));
        }

        [Test]
        public void Velocities_and_forces_warn_once_about_a_kinematic_body()
        {
            var node = MakeNode(3).Node;
            var parts = new Actuator[] { node.gameObject.AddComponent<Fly>(), node.gameObject.AddComponent<Push>() };
            node.GetComponent<Rigidbody>().isKinematic = true;
            Play(5);
            Assert.That(Log.FindAll(line => line.Contains("kinematic")), Is.EqualTo(Array.ConvertAll(parts, part => part.GetType().Name + " on '" + part.name
                + "' has no effect while its Rigidbody is kinematic: disable Is Kinematic, or move the node with a Move actuator")));
        }

        [Test]
        public void The_time_asleep_does_not_move_or_push_a_node()
        {
            var mover = MakeNode(500).Node;
            mover.gameObject.AddComponent<Move>().MaxSpeed = 4;
            var ball = MakeNode(5).Node;
            ball.gameObject.AddComponent<Push>().Mode = ForceMode.Acceleration;
            var body = ball.GetComponent<Rigidbody>();
            body.useGravity = false;
            Play(1);
            mover.Sleep(1);
            ball.Sleep(1);
            Play(20);
            Assert.That(mover.transform.position.x, Is.EqualTo(0.2f).Within(1e-6f));
            Assert.That(body.linearVelocity.x, Is.EqualTo(0.5f).Within(1e-6f));
            Play(1);
            Assert.That(mover.AnswerInterval, Is.EqualTo(0.05f).Within(1e-6f));
            Assert.That(mover.transform.position.x, Is.EqualTo(0.4f).Within(1e-6f));
            Assert.That(body.linearVelocity.x, Is.EqualTo(1).Within(1e-6f));
        }

        [TestCase(0.5f, 0)]
        [TestCase(0.07f, 0)]
        [TestCase(0.12f, 0)]
        [TestCase(0.2f, 0.19f)]
        public void A_body_with_asynchronous_rounds_does_not_pass_its_target(float period, float jitter)
        {
            Configure("double", ScheduleTests.Asynchronous(period, jitter));
            var node = MakeNode(1).Node;
            var body = node.gameObject.AddComponent<Rigidbody>();
            body.useGravity = false;
            var move = node.gameObject.AddComponent<Move>();
            move.ReachTime = 0.02f;
            move.MaxSpeed = 1000;
            for (var tick = 0; tick < 40; tick++)
            {
                if (tick == 20) node.Sleep(0.2);
                Play(1);
                Assert.That(node.transform.position.x, Is.LessThan(2.0001f), "tick " + tick);
            }
            Assert.That(node.transform.position.x, Is.EqualTo(2).Within(1e-3f));
        }

        [Test]
        public void A_body_moves_towards_its_target_while_gravity_acts()
        {
            var node = MakeNode(500).Node;
            var body = node.gameObject.AddComponent<Rigidbody>();
            node.gameObject.AddComponent<Move>().MaxSpeed = 2;
            Play(20);
            Assert.That(body.linearVelocity.x, Is.EqualTo(2).Within(0.01f));
            Assert.That(body.linearVelocity.y, Is.EqualTo(-9.81f).Within(0.1f));
            Assert.That(node.transform.position.x, Is.EqualTo(2).Within(0.1f));
        }

        [Test]
        public void A_body_that_was_added_after_the_components_is_driven_and_measured()
        {
            var node = MakeNode(500).Node;
            node.gameObject.AddComponent<Move>().MaxSpeed = 2;
            var sensor = node.gameObject.AddComponent<SensorTests.Velocity>();
            var body = node.gameObject.AddComponent<Rigidbody>();
            body.useGravity = false;
            Play(2);
            Assert.That(body.linearVelocity.x, Is.EqualTo(2).Within(1e-4f));
            Assert.That(sensor.Value.x, Is.EqualTo(2).Within(1e-4f));
            body.linearVelocity = new Vector3(0, 0, 3);
            Play(1);
            Assert.That(sensor.Value.z, Is.EqualTo(3).Within(1e-4f));
        }

        [Test]
        public void A_body_that_was_added_after_the_first_round_is_used_after_enabling_the_parts_again()
        {
            var node = MakeNode(500).Node;
            var move = node.gameObject.AddComponent<Move>();
            move.MaxSpeed = 2;
            var sensor = node.gameObject.AddComponent<SensorTests.Velocity>();
            Play(2);
            var body = node.gameObject.AddComponent<Rigidbody>();
            body.useGravity = false;
            move.enabled = sensor.enabled = false;
            move.enabled = sensor.enabled = true;
            Play(2);
            Assert.That(body.linearVelocity.x, Is.EqualTo(2).Within(1e-4f));
            body.linearVelocity = new Vector3(0, 0, 3);
            Play(1);
            Assert.That(sensor.Value.z, Is.EqualTo(3).Within(1e-4f));
        }

        [TestCase(false, false)]
        [TestCase(true, false)]
        [TestCase(true, true)]
        public void A_child_node_without_a_body_moves_alone(bool kinematic, bool isFirst)
        {
            var (carrier, node, sensor) = MakeCarriedNode(kinematic);
            node.gameObject.SetActive(isFirst);
            carrier.gameObject.AddComponent<Node>();
            node.gameObject.SetActive(true);
            Play(100);
            Assert.That(node.transform.position.x, Is.EqualTo(4).Within(0.01f));
            Assert.That(carrier.position, Is.EqualTo(Vector3.zero));
            node.GetComponent<Move>().enabled = false;
            node.transform.position += Vector3.forward;
            Play(1);
            Assert.That(sensor.Value.z, Is.EqualTo(20).Within(0.01f));
        }

        [TestCase(false)]
        [TestCase(true)]
        public void A_body_without_a_node_carries_its_node_to_the_target(bool kinematic)
        {
            var (carrier, node, _) = MakeCarriedNode(kinematic);
            node.gameObject.SetActive(true);
            Play(100);
            Assert.That(node.transform.position.x, Is.EqualTo(4).Within(0.01f));
            Assert.That(carrier.position.x, Is.EqualTo(3).Within(0.01f));
        }

        [Test]
        public void A_kinematic_body_is_moved_through_physics()
        {
            var node = MakeNode(500).Node;
            var body = node.gameObject.AddComponent<Rigidbody>();
            body.isKinematic = true;
            node.gameObject.AddComponent<Move>().MaxSpeed = 2;
            Play(20);
            Assert.That(node.transform.position.x, Is.EqualTo(2).Within(0.01f));
        }

        [Test]
        public void A_kinematic_body_pushes_at_its_own_speed_in_each_physics_step()
        {
            Configure("double", settings => settings.deltaTime = 0.1f);
            var node = MakeNode(500).Node;
            node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            node.gameObject.AddComponent<SphereCollider>();
            node.gameObject.AddComponent<Move>().MaxSpeed = 2;
            var pushed = GameObject.CreatePrimitive(PrimitiveType.Sphere).AddComponent<Rigidbody>();
            pushed.transform.position = new Vector3(1.5f, 0, 0);
            pushed.useGravity = false;
            Play(5);
            Assert.That(pushed.linearVelocity.x, Is.EqualTo(2).Within(0.1f));
        }

        [TestCase(false, 0.5f)]
        [TestCase(true, 0.05f)]
        public void A_kinematic_body_moves_in_all_ticks_between_its_answers_until_the_part_is_disabled(bool disabled, float end)
        {
            Configure("double", ScheduleTests.Asynchronous(0.5f));
            var node = MakeNode(500).Node;
            node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            var move = node.gameObject.AddComponent<Move>();
            move.MaxSpeed = 1;
            Play(10);
            var start = node.transform.position.x;
            Play(1);
            Assert.That(node.transform.position.x - start, Is.EqualTo(0.05f).Within(1e-4f));
            move.enabled = !disabled;
            Play(9);
            Assert.That(node.transform.position.x - start, Is.EqualTo(end).Within(1e-4f));
        }

        [TestCase(0.07f, 0)]
        [TestCase(0.125f, 0)]
        [TestCase(0.1f, 0.09f)]
        public void A_kinematic_body_has_its_speed_with_any_timing_of_rounds(float period, float jitter)
        {
            Configure("double", ScheduleTests.Asynchronous(period, jitter));
            var node = MakeNode(500).Node;
            node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            node.gameObject.AddComponent<Move>().MaxSpeed = 2;
            Play(10);
            var start = node.transform.position.x;
            Play(100);
            Assert.That(node.transform.position.x - start, Is.EqualTo(10).Within(0.01f));
        }

        [Test]
        public void A_kinematic_body_moves_to_its_target_and_stays_there_while_its_node_sleeps()
        {
            var node = MakeNode(1).Node;
            var body = node.gameObject.AddComponent<Rigidbody>();
            body.isKinematic = true;
            node.gameObject.AddComponent<Move>().MaxSpeed = 3;
            Play(1);
            node.Sleep(5);
            Play(3);
            body.position = new Vector3(2, 0, 3);
            Manager.Settings.deltaTime = 0.025f;
            Play(20);
            Assert.That(node.transform.position.z, Is.EqualTo(1.5f).Within(1e-4f));
            Play(30);
            Assert.That(node.transform.position, Is.EqualTo(new Vector3(2, 0, 0)));
        }

        [Test]
        public void The_last_of_several_move_actuators_moves_a_kinematic_body()
        {
            Configure("double", ScheduleTests.Asynchronous(0.5f));
            var node = MakeNode(500).Node;
            node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            node.gameObject.AddComponent<Move>().MaxSpeed = 2;
            var last = node.gameObject.AddComponent<MoveTo>();
            last.Target = new Vector3(0, 0, 0.1f);
            last.ReachTime = 0;
            Play(10);
            Assert.That(node.transform.position, Is.EqualTo(last.Target));
            last.Target = node.transform.position;
            Play(10);
            Assert.That(node.transform.position, Is.EqualTo(last.Target));
        }

        [Test]
        public void A_kinematic_body_moves_towards_a_target_at_any_distance()
        {
            var node = MakeNode(1e20f).Node;
            node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            node.gameObject.AddComponent<Move>().MaxSpeed = 2;
            Play(20);
            Assert.That(node.transform.position.x, Is.EqualTo(2).Within(0.01f));
        }

        [TestCase(false)]
        [TestCase(true)]
        public void A_node_that_leaves_and_joins_a_carrier_moves_alone_and_then_with_it(bool kinematic)
        {
            var (carrier, node, sensor) = MakeCarriedNode(kinematic);
            node.gameObject.SetActive(true);
            Play(5);
            node.transform.SetParent(null, true);
            if (!kinematic) carrier.linearVelocity = Vector3.forward;
            var start = node.transform.position.x;
            var place = carrier.position.x;
            Play(10);
            Assert.That(node.transform.position.x - start, Is.GreaterThan(0.1f));
            Assert.That(carrier.position.x, Is.EqualTo(place).Within(1e-4f));
            Assert.That(sensor.Value.z, Is.EqualTo(0));
            node.transform.SetParent(carrier.transform, true);
            Play(10);
            Assert.That(carrier.position.x - place, Is.GreaterThan(0.1f));
        }

        [Test]
        public void A_target_at_any_distance_gives_a_direction()
        {
            var node = MakeNode(1e20f).Node;
            node.gameObject.AddComponent<Move>().MaxSpeed = 2;
            Play(20);
            Assert.That(node.transform.position.x, Is.EqualTo(2).Within(0.01f));
        }

        [Test]
        public void Parts_with_new_parents_use_the_body_of_their_new_node()
        {
            var first = MakeNode(500).Node.gameObject.AddComponent<Rigidbody>();
            var second = MakeNode(500, Vector3.up).Node.gameObject.AddComponent<Rigidbody>();
            first.useGravity = second.useGravity = false;
            var arm = new GameObject("Arm");
            arm.transform.SetParent(first.transform, false);
            arm.AddComponent<Move>().MaxSpeed = 2;
            var sensor = arm.AddComponent<SensorTests.Velocity>();
            Play(2);
            first.linearVelocity = Vector3.zero;
            arm.transform.SetParent(second.transform, false);
            second.linearVelocity = Vector3.forward;
            Play(1);
            Assert.That(sensor.Value, Is.EqualTo(Vector3.forward));
            Assert.That(second.linearVelocity.x, Is.EqualTo(2).Within(1e-3f));
            Assert.That(first.linearVelocity.x, Is.EqualTo(0));
        }

        [Test]
        public void A_moved_collider_without_a_body_is_warned_about_once()
        {
            var warnings = 0;
            Application.logMessageReceived += (text, stack, type) =>
                warnings += type == LogType.Warning && text.Contains("collider without a Rigidbody") ? 1 : 0;
            for (var i = 0; i < 2; i++)
            {
                var node = MakeNode(500).Node;
                node.gameObject.AddComponent<SphereCollider>();
                node.gameObject.AddComponent<Move>();
            }
            var free = MakeNode(500).Node;
            free.gameObject.AddComponent<Move>();
            Play(3);
            Assert.That(warnings, Is.EqualTo(1));
        }

        [TestCase(ForceMode.Force, 6 * 0.05f / 3)]
        [TestCase(ForceMode.Acceleration, 6 * 0.05f)]
        [TestCase(ForceMode.Impulse, 6 / 3f)]
        [TestCase(ForceMode.VelocityChange, 6f)]
        public void A_force_acts_over_the_whole_tick(ForceMode mode, float speedAfterOneTick)
        {
            var node = MakeNode(3).Node;
            var push = node.gameObject.AddComponent<Push>();
            push.Mode = mode;
            var body = node.GetComponent<Rigidbody>();
            body.mass = 3;
            body.useGravity = false;
            Play(1);
            Assert.That(body.linearVelocity.x, Is.EqualTo(speedAfterOneTick).Within(1e-4f));
        }

        [Test]
        public void SetVelocity_replaces_the_velocity_and_can_keep_the_vertical_part()
        {
            var node = MakeNode(3).Node;
            var fly = node.gameObject.AddComponent<Fly>();
            var body = node.GetComponent<Rigidbody>();
            Play(2);
            Assert.That(body.linearVelocity.x, Is.EqualTo(6));
            Assert.That(body.linearVelocity.y, Is.EqualTo(-0.05f * 9.81f).Within(1e-3f), "the velocity must be the gravity of one tick");
            fly.KeepVertical = true;
            Play(1);
            Assert.That(body.linearVelocity.y, Is.EqualTo(-0.1f * 9.81f).Within(1e-3f));
        }

        [Test]
        public void A_node_is_coloured_without_copying_its_material()
        {
            var node = MakeNode(0.5f).Node;
            var ball = GameObject.CreatePrimitive(PrimitiveType.Sphere).GetComponent<Renderer>();
            ball.transform.SetParent(node.transform, false);
            var material = ball.sharedMaterial;
            node.gameObject.AddComponent<Tint>();
            Play(1);
            var block = new MaterialPropertyBlock();
            ball.GetPropertyBlock(block);
            Assert.That(block.GetColor("_Color"), Is.EqualTo(Color.red));
            Assert.That(block.GetColor("_BaseColor"), Is.EqualTo(Color.red));
            Assert.That(ball.sharedMaterial, Is.SameAs(material));
        }

        [Test]
        public void A_colour_actuator_without_a_renderer_reports_it_and_disables_itself()
        {
            var node = MakeNode(1);
            node.Node.name = "bare";
            Assert.That(node.Node.gameObject.AddComponent<Tint>().enabled, Is.False);
            Assert.That(Errors[0], Is.StringContaining("Tint").And.StringContaining("bare").And.StringContaining("Renderer"));
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(2));
        }

        [Test]
        public void A_node_does_not_colour_the_renderer_of_a_child_node()
        {
            var node = MakeNode(0.5f).Node;
            var child = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            child.AddComponent<Node>();
            child.transform.SetParent(node.transform, false);
            var own = GameObject.CreatePrimitive(PrimitiveType.Sphere).GetComponent<Renderer>();
            own.transform.SetParent(node.transform, false);
            Assert.That(node.gameObject.AddComponent<Tint>().Target, Is.SameAs(own));
        }

        [Test]
        public void Components_of_any_kind_are_enabled_and_disabled()
        {
            var node = MakeNode(0);
            var ball = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            var other = MakeNode(0).Actuator;
            var switches = new[] { node.Node.gameObject.AddComponent<Switch>(), node.Node.gameObject.AddComponent<Switch>(),
                node.Node.gameObject.AddComponent<Switch>() };
            switches[0].Target = ball.GetComponent<Renderer>();
            switches[1].Target = ball.GetComponent<Collider>();
            switches[2].Target = other;
            Play(1);
            Assert.That(ball.GetComponent<Renderer>().enabled || ball.GetComponent<Collider>().enabled || other.enabled, Is.False);
            node.Sensor.Value = 1;
            Play(1);
            Assert.That(ball.GetComponent<Renderer>().enabled && ball.GetComponent<Collider>().enabled && other.enabled, Is.True);
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void An_enable_actuator_with_an_invalid_target_reports_it()
        {
            var node = MakeNode(0).Node;
            var toggle = node.gameObject.AddComponent<Switch>();
            Play(1);
            Assert.That(Errors[0], Is.StringContaining("Switch").And.StringContaining("not set"));
            toggle.Target = node.transform;
            Play(1);
            Assert.That(Errors[1], Is.StringContaining("Transform"));
        }

        [Test]
        public void A_non_finite_answer_is_rejected_before_it_reaches_physics()
        {
            var node = MakeNode(float.MaxValue).Node;
            node.gameObject.AddComponent<Fly>();
            Play(1);
            Assert.That(Errors[0], Is.StringContaining("Fly").And.StringContaining("node 0"));
            Assert.That(node.LastError, Is.StringContaining("not finite"));
            Assert.That(node.GetComponent<Rigidbody>().linearVelocity.x, Is.EqualTo(0));
        }

        /// <summary>Makes an inactive node with the target 4 m, which is a child of a body and 1 m away from it.</summary>
        private static (Rigidbody Carrier, Node Node, SensorTests.Velocity Sensor) MakeCarriedNode(bool kinematic)
        {
            var carrier = new GameObject("Carrier").AddComponent<Rigidbody>();
            carrier.useGravity = false;
            carrier.isKinematic = kinematic;
            var node = MakeNode(2, Vector3.right).Node;
            node.gameObject.SetActive(false);
            node.transform.SetParent(carrier.transform, true);
            node.gameObject.AddComponent<Move>();
            return (carrier, node, node.gameObject.AddComponent<SensorTests.Velocity>());
        }

        public sealed class MoveTo : MoveActuator<ActuatorData>
        {
            internal Vector3 Target { get; set; }

            protected override Vector3 Read(ActuatorData data) => Target;
        }

        public sealed class Move : MoveActuator<ActuatorData>
        {
            protected override Vector3 Read(ActuatorData data) => new Vector3(data.Value, 0, 0);
        }

        public sealed class Push : AddForceActuator<ActuatorData>
        {
            protected override Vector3 Read(ActuatorData data) => new Vector3(data.Value, 0, 0);
        }

        public sealed class Fly : SetVelocityActuator<ActuatorData>
        {
            protected override Vector3 Read(ActuatorData data) => new Vector3(data.Value, 0, 0);
        }

        public sealed class Tint : ColourActuator<ActuatorData>
        {
            protected override Color Read(ActuatorData data) => data.Value > 0 ? Color.red : Color.blue;
        }

        public sealed class Switch : EnableActuator<ActuatorData>
        {
            protected override bool Read(ActuatorData data) => data.Value > 0;
        }
    }
}
