using System;
using System.Collections.Generic;
using Collektive.Bridge;
using NUnit.Framework;
using probe;

namespace Collektive.Headless.Tests.Bridge
{
    /// <summary>Tests sessions without Unity. Frames of 500 nodes pass through the shim to programs and back.</summary>
    [TestFixture]
    public sealed class SessionTests
    {
        private const int Nodes = 500;
        private const int Limit = 10000;

        private Session session;

        [SetUp]
        public void StartJvm()
        {
            TestJvm.Start();
        }

        [TearDown]
        public void CloseSession()
        {
            session?.Dispose();
            session = null;
        }

        [Test]
        public void Each_of_500_nodes_in_a_ring_receives_the_sum_of_both_neighbours()
        {
            session = Open("sum");
            AddRing();
            for (var tick = 0; tick < 50; tick++)
            {
                Fill(i => i + tick);
                session.Step(0.05, Limit);
                Assert.That(session.Answer.NodeCount, Is.EqualTo(Nodes));
                Assert.That(session.Answer.EngineLinks, Is.EqualTo(2 * Nodes));
                var actuators = (ActuatorBuffer<ActuatorData>)session.Answer.Actuators;
                for (var i = 0; i < Nodes; i++)
                {
                    Assert.That(session.Answer.Nodes[i], Is.EqualTo(i));
                    var left = (i + Nodes - 1) % Nodes + tick - 1;
                    var right = (i + 1) % Nodes + tick - 1;
                    Assert.That(actuators[i].Value, Is.EqualTo(tick == 0 ? 0 : left + right), "tick " + tick + ", node " + i);
                }
            }
        }

        [Test]
        public void A_tick_allocates_no_managed_memory_in_steady_state()
        {
            session = Open("sum");
            AddRing();
            for (var i = 0; i < 50; i++) Tick();
            var bytes = AllocatedBy(() => { for (var i = 0; i < 300; i++) Tick(); });
            var control = AllocatedBy(() => { for (var i = 0; i < 300; i++) { Tick(); Keep = new byte[100]; } });
            Assert.That(control, Is.GreaterThan(300 * 100), "the measurement must detect the allocations of the control");
            Assert.That(bytes, Is.EqualTo(0));
        }

        [Test]
        public void A_rejected_frame_reports_the_reason_and_changes_nothing()
        {
            var undisturbed = DigestOfRing(() => { });
            var disturbed = DigestOfRing(() =>
            {
                // Of the changes in this request, only the last one is invalid.
                session.Request.RemoveNode(0);
                session.Request.AddNode(Nodes, "", null);
                session.Request.RemoveLink(new LinkEnds { From = 1, To = 2 });
                session.Request.SetLink(new LinkRecord { From = 5, To = 50, Length = 1 });
                session.Request.SetLink(new LinkRecord { From = 1, To = 100000 });
                var (tick, time) = (session.Tick, session.Time);
                var error = Assert.Throws<BridgeException>(Tick);
                Assert.That(error.Error, Is.EqualTo(BridgeError.Frame));
                Assert.That(error.Message, Is.StringContaining("100000"));
                Assert.That((session.Tick, session.Time), Is.EqualTo((tick, time)));
                session.Request.Clear();
            });
            Assert.That(disturbed, Is.EqualTo(undisturbed));
        }

        [Test]
        public void The_time_is_a_multiple_of_a_delta_time_with_many_decimals()
        {
            session = Open("sum");
            for (var i = 0; i < 8192 / 4; i++) session.Step(1 / 8192.0, Limit);
            Assert.That(session.Time, Is.EqualTo(0.25));
            for (var i = 0; i < 3; i++) session.Step(0.1, Limit);
            Assert.That(session.Time, Is.EqualTo(0.55));
        }

        [Test]
        public void A_closed_session_rejects_steps_and_can_be_closed_again()
        {
            session = Open("sum");
            session.Dispose();
            session.Dispose();
            Assert.Throws<ObjectDisposedException>(() => session.Step(0.05, Limit));
        }

        [Test]
        public void A_different_schema_is_rejected_and_the_error_names_the_type()
        {
            var error = Assert.Throws<BridgeException>(() => Session.Open(Settings("sum"), new ChangedSchema()));
            Assert.That(error.Error, Is.EqualTo(BridgeError.Schema));
            Assert.That(error.Message, Is.StringContaining("ActuatorData"));
        }

        [Test]
        public void Two_sessions_run_independently()
        {
            session = Open("double");
            using (var other = Open("double"))
            {
                foreach (var each in new[] { session, other })
                {
                    each.Request.AddNode(1, "", null);
                    each.Request.AddDue(1);
                    each.Request.Sensors.EnsureCapacity(1);
                    each.Request.Sensors.Clear(0);
                    ((SensorBuffer<SensorData>)each.Request.Sensors).Items[0].Value = each == session ? 1 : 10;
                }
                other.Step(0.1, Limit);
                session.Step(0.1, Limit);
                Assert.That(((ActuatorBuffer<ActuatorData>)other.Answer.Actuators)[0].Value, Is.EqualTo(20));
                Assert.That(((ActuatorBuffer<ActuatorData>)session.Answer.Actuators)[0].Value, Is.EqualTo(2));
            }
        }

        /// <summary>Keeps an array, so that the compiler cannot remove the allocation of the control.</summary>
        public static byte[] Keep { get; private set; }

        private static long AllocatedBy(Action action)
        {
            action();
            var before = GC.GetAllocatedBytesForCurrentThread();
            action();
            return GC.GetAllocatedBytesForCurrentThread() - before;
        }

        private static SessionSettings Settings(string program) => new SessionSettings
        {
            Seed = 1,
            Program = program,
            Jars = new[] { TestJvm.Variable("COLLEKTIVE_PROBE_JAR") },
        };

        private static Session Open(string program) => Session.Open(Settings(program), new ProbeSchema());

        private void AddRing()
        {
            for (var i = 0; i < Nodes; i++)
            {
                session.Request.AddNode(i, "", null);
                session.Request.SetLink(new LinkRecord { From = i, To = (i + 1) % Nodes, Length = 1 });
                session.Request.SetLink(new LinkRecord { From = (i + 1) % Nodes, To = i, Length = 1 });
            }
        }

        /// <summary>Returns the digest and the size of a ring after six ticks. Runs an action after the third tick.</summary>
        private (ulong Digest, int Nodes, int Links) DigestOfRing(Action act)
        {
            using (session = Open("sum"))
            {
                AddRing();
                for (var i = 0; i < 3; i++) Tick();
                act();
                for (var i = 0; i < 3; i++) Tick();
                return (session.Answer.Digest, session.Answer.EngineNodes, session.Answer.EngineLinks);
            }
        }

        private void Tick()
        {
            Fill(null);
            session.Step(0.05, Limit);
        }

        private void Fill(Func<int, float> value)
        {
            var sensors = (SensorBuffer<SensorData>)session.Request.Sensors;
            sensors.EnsureCapacity(Nodes);
            session.Request.ClearDue();
            for (var i = 0; i < Nodes; i++)
            {
                sensors.Clear(i);
                sensors.Items[i].Value = value == null ? i : value(i);
                session.Request.AddDue(i);
            }
        }

        /// <summary>The probe schema, but with a different fingerprint of the actuator data.</summary>
        private sealed class ChangedSchema : DataSchema
        {
            private readonly ProbeSchema probe = new ProbeSchema();

            public override string Name => probe.Name;

            public override string File => probe.File;

            public override IReadOnlyList<KeyValuePair<string, ulong>> Types
            {
                get
                {
                    var types = new List<KeyValuePair<string, ulong>>();
                    foreach (var type in probe.Types)
                    {
                        types.Add(new KeyValuePair<string, ulong>(type.Key, type.Key == "ActuatorData" ? type.Value ^ 1 : type.Value));
                    }
                    return types;
                }
            }

            public override SensorBuffer CreateSensors() => probe.CreateSensors();

            public override ActuatorBuffer CreateActuators() => probe.CreateActuators();
        }
    }
}
