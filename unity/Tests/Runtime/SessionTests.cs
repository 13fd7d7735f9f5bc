using System.Collections.Generic;
using System.Runtime.InteropServices;
using Collektive.Bridge;
using NUnit.Framework;
using org.collektive.schema;

namespace Collektive.Unity.Tests
{
    /// <summary>Tests rounds of a sample's program with the installed package and JVM.</summary>
    public sealed class SessionTests
    {
        private const int Nodes = 4;

        [Test]
        public void Nodes_in_a_row_elect_the_greatest_id_on_a_real_JVM()
        {
            // If the editor has played a scene before, the JVM is already running.
            if (Jvm.State != JvmState.Running) Jvm.Start(Installation.ToLaunch(new JvmSettings()));
            var settings = new SessionSettings
            {
                Program = "leader-election",
                Jars = new[] { Installation.PathOf("Packages/org.collektive.unity/Samples~/LeaderElection/leader_election.clkprograms") },
            };
            using (var session = Session.Open(settings, new ElectionSchema()))
            {
                AddRow(session.Request);
                for (var tick = 1; tick <= 2 * Nodes; tick++)
                {
                    Sense(session.Request);
                    session.Step(0.1, 10000);
                }
                Assert.That(session.Answer.NodeCount, Is.EqualTo(Nodes));
                var answers = (ActuatorBuffer<Election>)session.Answer.Actuators;
                for (var node = 0; node < Nodes; node++)
                {
                    Assert.That((answers[node].Leader, answers[node].Metres), Is.EqualTo((Nodes - 1, (float)(Nodes - 1 - node))), "node " + node);
                }
            }
        }

        /// <summary>Adds nodes in a row, 1 m apart, each linked to the next.</summary>
        private static void AddRow(StepRequest request)
        {
            for (var node = 0; node < Nodes; node++)
            {
                request.AddNode(node, "", null);
                if (node == 0) continue;
                request.SetLink(new LinkRecord { From = node, To = node - 1, Length = 1 });
                request.SetLink(new LinkRecord { From = node - 1, To = node, Length = 1 });
            }
        }

        private static void Sense(StepRequest request)
        {
            var sensors = (SensorBuffer<Place>)request.Sensors;
            sensors.EnsureCapacity(Nodes);
            request.ClearDue();
            for (var node = 0; node < Nodes; node++)
            {
                sensors.Items[node].Position = new Vector3Value(node, 0, 0);
                request.AddDue(node);
            }
        }

        /// <summary>
        /// The part of the generated code for the sample's leader_election.fbs that the test needs. The class is private, because a project that contains the
        /// sample has another schema of the same name.
        /// </summary>
        private sealed class ElectionSchema : DataSchema
        {
            public override string Name => "leaderelection.LeaderElectionSchema";

            public override string File => "leader_election";

            public override IReadOnlyList<KeyValuePair<string, ulong>> Types { get; } = new[]
            {
                new KeyValuePair<string, ulong>("SensorData", 0x1e1b99fee8474fabUL), new KeyValuePair<string, ulong>("ActuatorData", 0x6f3185b64538c843UL),
            };

            public override SensorBuffer CreateSensors() => new StructSensorBuffer<Place>(4);

            public override ActuatorBuffer CreateActuators() => new StructActuatorBuffer<Election>();
        }

        [StructLayout(LayoutKind.Sequential)]
        private struct Place : IMirror
        {
            internal Vector3Value Position;

            public string FindNotFinite() => Position.FindNotFinite();
        }

        [StructLayout(LayoutKind.Sequential)]
        private struct Election : IMirror
        {
            internal int Leader;
            internal float Metres;

            public string FindNotFinite() => float.IsFinite(Metres) ? null : "distance";
        }
    }
}
