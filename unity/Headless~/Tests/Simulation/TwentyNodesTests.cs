using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests twenty nodes on a line with values that are calculated by hand. The nodes are 1 m apart and linked within 1.5 m.</summary>
    [TestFixture]
    public sealed class TwentyNodesTests : SimulationFixture
    {
        private const int Count = 20;

        private readonly ProbeNode[] line = new ProbeNode[Count];

        [Test]
        public void In_lockstep_hops_travel_one_node_per_tick()
        {
            Configure("hops");
            MakeLine();
            for (var tick = 1; tick <= 25; tick++)
            {
                Play(1);
                for (var i = 0; i < Count; i++)
                {
                    Assert.That(line[i].Answer, Is.EqualTo(i < tick ? i : -1), "tick " + tick + ", node " + i);
                }
            }
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void In_sequence_hops_travel_along_ascending_ids_within_one_tick()
        {
            Configure("hops", settings => settings.schedule = Schedule.Sequential);
            MakeLine();
            Play(1);
            for (var i = 0; i < Count; i++) Assert.That(line[i].Answer, Is.EqualTo(i), "node " + i);
        }

        [Test]
        public void A_node_receives_its_neighbours_values_of_the_previous_tick()
        {
            Configure("sum");
            MakeLine();
            Play(1);
            for (var i = 0; i < Count; i++) Assert.That(line[i].Actuator.Last.Heard, Is.EqualTo(0), "first tick, node " + i);
            for (var i = 0; i < Count; i++) line[i].Sensor.Value = 1000;
            Play(1);
            for (var i = 0; i < Count; i++)
            {
                var left = i > 0 ? i - 1 : 0;
                var right = i < Count - 1 ? i + 1 : 0;
                Assert.That(line[i].Answer, Is.EqualTo(left + right), "node " + i);
                Assert.That(line[i].Actuator.Last.Heard, Is.EqualTo(i == 0 || i == Count - 1 ? 1 : 2), "node " + i);
            }
        }

        [Test]
        public void Standard_library_distances_converge_to_hop_distances()
        {
            Configure("far");
            MakeLine();
            Play(Count + 1);
            for (var i = 0; i < Count; i++) Assert.That(line[i].Answer, Is.EqualTo(i), "node " + i);
            line[10].Sensor.Value = 0;
            Play(Count + 1);
            for (var i = 0; i < Count; i++) Assert.That(line[i].Answer, Is.EqualTo(System.Math.Min(i, System.Math.Abs(i - 10))), "node " + i);
        }

        [Test]
        public void Nodes_in_different_branches_do_not_exchange_messages()
        {
            Configure("arms");
            MakeLine();
            // The first ten nodes take one branch, and the other nodes take the other branch. Only the two nodes at the border lose a neighbour.
            for (var i = 0; i < 10; i++) line[i].Sensor.Value = -1;
            Play(2);
            for (var i = 0; i < Count; i++)
            {
                var heard = i == 0 || i == Count - 1 || i == 9 || i == 10 ? 1 : 2;
                Assert.That(line[i].Actuator.Last.Heard, Is.EqualTo(heard), "node " + i);
                Assert.That(line[i].Answer, Is.EqualTo(i < 10 ? -1 : 1), "node " + i);
            }
        }

        [Test]
        public void Each_tick_is_one_call_and_links_exist_in_both_directions()
        {
            var before = Collektive.Bridge.Jvm.StepCalls;
            MakeLine();
            Play(7);
            Assert.That(Collektive.Bridge.Jvm.StepCalls - before, Is.EqualTo(7));
            Assert.That(Manager.Tick, Is.EqualTo(7));
            Assert.That(Manager.LinkCount, Is.EqualTo(2 * (Count - 1)));
            Assert.That(Manager.HasLink(3, 4) && Manager.HasLink(4, 3) && !Manager.HasLink(3, 5), Is.True);
        }

        [Test]
        public void A_node_that_moves_out_of_range_is_no_longer_received()
        {
            Configure("sum");
            MakeLine();
            Play(2);
            line[1].Node.transform.position += new Vector3(0, 0, 50);
            Play(1);
            Assert.That(line[0].Actuator.Last.Heard, Is.EqualTo(0));
            Assert.That(line[2].Answer, Is.EqualTo(3));
            line[1].Node.transform.position -= new Vector3(0, 0, 50);
            Play(2);
            Assert.That(line[2].Answer, Is.EqualTo(1 + 3));
        }

        private void MakeLine()
        {
            for (var i = 0; i < Count; i++)
            {
                line[i] = MakeNode(i, new Vector3(i, 0, 0));
                line[i].Node.gameObject.AddComponent<RadiusNeighbourhood>().Radius = 1.5f;
            }
        }
    }
}
