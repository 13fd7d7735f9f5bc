using System;
using System.Collections.Generic;
using System.Diagnostics;
using Collektive.Unity;
using NUnit.Framework;
using probe;
using UnityEngine;
using UnityEngine.Headless;
using Core = Collektive.Unity.Simulation;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests a simulation without a manager, play mode or frames.</summary>
    [TestFixture]
    public sealed class SimulationTests
    {
        private readonly List<string> log = new List<string>();
        private static string callAt;
        private static Action call;
        private Core simulation;

        /// <summary>The calls of the nodes' components in order.</summary>
        private static List<string> Steps { get; } = new List<string>();

        [SetUp]
        public void Make()
        {
            Loop.Reset();
            Steps.Clear();
            callAt = null;
            log.Clear();
            Application.logMessageReceivedThreaded += Keep;
            Physics.simulationMode = SimulationMode.Script;
            Installation.HostJar = TestJvm.HostJar;
            Installation.JavaHome = TestJvm.Home;
            var settings = new SimulationSettings
            {
                schema = "probe.ProbeSchema",
                jars = { TestJvm.Variable("COLLEKTIVE_PROBE_JAR") },
                program = "sum",
                jvm = ScriptableObject.CreateInstance<JvmSettingsAsset>(),
            };
            settings.jvm.settings = TestJvm.Settings;
            simulation = new Core(settings, new SceneGlobals(), null);
        }

        [TearDown]
        public void End()
        {
            simulation.End();
            Application.logMessageReceivedThreaded -= Keep;
            Loop.Reset();
        }

        [Test]
        public void Nodes_that_join_run_rounds_and_exchange_messages()
        {
            var a = Join(1);
            var b = Join(10);
            simulation.ScriptLinks.Add(0, 1, false);
            Assert.That(simulation.TryOpen(), Is.True);
            Assert.That(simulation.TryTick() && simulation.TryTick(), Is.True);
            Assert.That((Value(a), Value(b)), Is.EqualTo((10f, 1f)));
            Assert.That((simulation.Tick, simulation.Time), Is.EqualTo((2UL, 0.1)));
            Assert.That((a.Simulation, a.Id, b.Id), Is.EqualTo((simulation, 0, 1)));
        }

        [Test]
        public void A_tick_runs_rules_sensors_actuators_and_physics_in_this_order()
        {
            var falling = Join(1).gameObject.AddComponent<Rigidbody>();
            Join(2);
            simulation.TryOpen();
            callAt = "actuator 1";
            call = () => Assert.That(falling.position.y, Is.EqualTo(0));
            simulation.TryTick();
            Assert.That(Steps, Is.EqualTo(new[] { "rule 0", "rule 1", "sensor 0", "sensor 1", "actuator 0", "actuator 1" }));
            Assert.That(falling.position.y, Is.LessThan(0));
        }

        [TestCase("rule")]
        [TestCase("sensor")]
        [TestCase("actuator")]
        public void A_component_that_ends_the_simulation_skips_the_rest_of_the_tick(string kind)
        {
            var node = Join(1);
            Join(2);
            simulation.TryOpen();
            simulation.TryTick();
            Steps.Clear();
            callAt = kind + " 0";
            call = () => simulation.Fail("enough");
            Assert.That(simulation.TryTick(), Is.False);
            Assert.That(Steps[Steps.Count - 1], Is.EqualTo(callAt));
            Assert.That((simulation.Failure, simulation.IsOpen, simulation.Nodes.Count, node.Id), Is.EqualTo(("enough", false, 0, -1)));
            Assert.That(log, Is.EqualTo(new[] { "Simulation stopped: enough" }));
        }

        [TestCase(null)]
        [TestCase("")]
        public void Fail_without_a_message_is_a_failure(string message)
        {
            simulation.Fail(message);
            Assert.That(simulation.Failure, Is.EqualTo("a script called Fail without a message"));
            Assert.That(log, Is.EqualTo(new[] { "Simulation stopped: " + simulation.Failure }));
        }

        [Test]
        public void An_ended_simulation_has_no_nodes_links_or_time_but_keeps_its_digest()
        {
            Join(1);
            Join(2);
            simulation.ScriptLinks.Add(0, 1, false);
            simulation.TryOpen();
            simulation.TryTick();
            var digest = simulation.Digest;
            simulation.End();
            simulation.End();
            Assert.That((simulation.Nodes.Count, simulation.PresentLinks.Count, simulation.Tick, simulation.Time), Is.EqualTo((0, 0, 0UL, 0.0)));
            Assert.That(digest, Is.Not.EqualTo(0));
            Assert.That(simulation.Digest, Is.EqualTo(digest));
            Assert.That(log, Is.Empty);
        }

        [Test]
        public void Invalid_settings_are_reported_when_the_simulation_opens()
        {
            simulation.Settings.physicsStep = 1;
            Assert.That(simulation.TryOpen(), Is.False);
            Assert.That(simulation.Failure, Is.EqualTo("physics step is 1 s: it must be greater than 0 and at most 0.02"));
            Assert.That(log, Is.EqualTo(new[] { "Simulation stopped: " + simulation.Failure }));
        }

        [Test]
        public void Nodes_leave_before_their_first_tick_in_linear_time()
        {
            // With a separate search for each node, 16 times as many nodes would take 256 times as long.
            Assert.That(Leave(16000), Is.LessThan(64 * Leave(1000) + 100));
        }

        [Test]
        public void A_node_that_left_before_its_first_tick_has_no_round()
        {
            var nodes = new[] { Join(1), Join(2), Join(3) };
            simulation.Leave(nodes[1]);
            simulation.Join(nodes[1]);
            simulation.Leave(nodes[0]);
            simulation.TryOpen();
            Assert.That(simulation.TryTick(), Is.True);
            Assert.That((simulation.DueCount, Value(nodes[1]), Value(nodes[2])), Is.EqualTo((2, 0f, 0f)));
        }

        private double Leave(int count)
        {
            for (var i = 0; i < count; i++) Join(i);
            var clock = Stopwatch.StartNew();
            simulation.End();
            return clock.Elapsed.TotalMilliseconds;
        }

        private Node Join(float value)
        {
            var holder = new GameObject("Node");
            holder.transform.position = new Vector3(10 * value, 0, 0);
            var node = holder.AddComponent<Node>();
            holder.AddComponent<RecordedRule>();
            holder.AddComponent<RecordedSensor>().Value = value;
            holder.AddComponent<RecordedActuator>();
            simulation.Join(node);
            return node;
        }

        private static float Value(Node node)
        {
            Assert.That(node.TryGetAnswer(out ActuatorData data), Is.True);
            return data.Value;
        }

        private void Keep(string message, string stack, LogType type)
        {
            if (type == LogType.Log) return;
            lock (log) log.Add(message);
        }

        private static void Note(string step)
        {
            Steps.Add(step);
            if (step == callAt) call();
        }

        private sealed class RecordedRule : NeighbourhoodRule
        {
            protected override void FindNeighbours(NeighbourCollector neighbours) => Note("rule " + Node.Id);
        }

        private sealed class RecordedSensor : Sensor<SensorData>
        {
            internal float Value { get; set; }

            protected override void Sense(ref SensorData data)
            {
                data.Value = Value;
                Note("sensor " + Node.Id);
            }
        }

        private sealed class RecordedActuator : Actuator<ActuatorData>
        {
            protected override void Act(ActuatorData data) => Note("actuator " + Node.Id);
        }
    }
}
