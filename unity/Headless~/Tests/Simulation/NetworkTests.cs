using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests the network model in a scene with ticks of 0.05 s.</summary>
    [TestFixture]
    public sealed class NetworkTests : SimulationFixture
    {
        [Test]
        public void An_ideal_network_counts_sent_messages()
        {
            Line(new NetworkModel(), out _, out _, out _);
            Play(2);
            Assert.That(Manager.Network, Is.EqualTo(new NetworkCounts(4, 0, 0, 0)));
        }

        [Test]
        public void Lost_messages_are_counted_and_not_received()
        {
            Line(new NetworkModel { loss = 1 }, out _, out var middle, out _);
            Play(2);
            Assert.That(Manager.Network, Is.EqualTo(new NetworkCounts(4, 4, 0, 0)));
            Assert.That(middle.Actuator.Last.Heard, Is.EqualTo(0));
        }

        [Test]
        public void A_message_arrives_after_its_delay_and_expires_after_its_retention()
        {
            Line(new NetworkModel { delay = 0.1, retention = 0.15 }, out var left, out var middle, out _);
            Play(1);
            Assert.That(Manager.Network, Is.EqualTo(new NetworkCounts(4, 0, 4, 0)));
            left.Node.Sleep(100);
            Play(1);
            Assert.That(middle.Actuator.Last.Heard, Is.EqualTo(0));
            Play(1);
            Assert.That(middle.Actuator.Last.Heard, Is.EqualTo(2));
            Play(3);
            Assert.That(middle.Actuator.Last.Heard, Is.EqualTo(2));
            Play(1);
            Assert.That(middle.Actuator.Last.Heard, Is.EqualTo(1));
        }

        [Test]
        public void Loss_grows_with_the_links_length()
        {
            Configure("sum", settings => settings.network.lossPerMetre = 0.25);
            var near = MakeNode(1);
            var far = MakeNode(2, new Vector3(5, 0, 0));
            var centre = MakeNode(3, new Vector3(0.001f, 0, 0));
            Manager.AddLink(near.Node.Id, centre.Node.Id, directed: true);
            Manager.AddLink(far.Node.Id, centre.Node.Id, directed: true);
            Play(5);
            Assert.That(centre.Answer, Is.EqualTo(1));
            Assert.That(Manager.Network.Dropped, Is.EqualTo(1));
        }

        [TestCase(1.5, 0, 0, "network loss is 1.5")]
        [TestCase(double.NaN, 0, 0, "network loss is NaN")]
        [TestCase(0, -1, 0, "network delay is -1 s")]
        [TestCase(0, 0, 0.01, "network retention is 0.01 s")]
        [TestCase(0, 0, -2, "network retention is -2 s")]
        public void A_value_out_of_range_is_rejected_before_the_start(double loss, double delay, double retention, string expected)
        {
            Configure("sum", settings => settings.network = new NetworkModel { loss = loss, delay = delay, retention = retention });
            MakeNode(1);
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining(expected));
            Assert.That(Manager.Tick, Is.EqualTo(0));
        }

        [TestCase(0.8, 4)]
        [TestCase(0.9, 9)]
        public void A_burst_length_can_be_the_least_possible(double share, double length)
        {
            Configure("sum", settings => settings.network = new NetworkModel { burstShare = share, burstLength = length });
            MakeNode(1);
            Play(1);
            Assert.That(Manager.Failure, Is.Empty);
        }

        [Test]
        public void A_retention_with_more_digits_than_a_float_can_be_the_delta_time()
        {
            Configure("sum", settings =>
            {
                settings.deltaTime = 1 / 60f;
                settings.network.retention = 1 / 60.0;
            });
            var left = MakeNode(1);
            var right = MakeNode(2);
            Manager.AddLink(left.Node.Id, right.Node.Id, directed: true);
            Play(60);
            Assert.That(Manager.Failure, Is.Empty);
            Assert.That(right.Answer, Is.EqualTo(1));
        }

        /// <summary>Creates three nodes in a row, each linked to the next.</summary>
        private void Line(NetworkModel network, out ProbeNode left, out ProbeNode middle, out ProbeNode right)
        {
            Configure("sum", settings => settings.network = network);
            left = MakeNode(1);
            middle = MakeNode(10);
            right = MakeNode(100);
            Manager.AddLink(left.Node.Id, middle.Node.Id);
            Manager.AddLink(middle.Node.Id, right.Node.Id);
        }
    }
}
