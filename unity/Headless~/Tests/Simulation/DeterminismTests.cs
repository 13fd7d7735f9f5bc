using System;
using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests that the same scene, seed and inputs give bit-identical rounds, by comparing the chained digests.</summary>
    [TestFixture]
    public sealed class DeterminismTests : SimulationFixture
    {
        private const int Ticks = 12;

        [TestCase(Schedule.Lockstep)]
        [TestCase(Schedule.Sequential)]
        [TestCase(Schedule.Asynchronous)]
        public void Digests_are_equal_for_any_number_of_threads(Schedule schedule)
        {
            Action<SimulationSettings> With(int threads) => settings =>
            {
                settings.threads = threads;
                settings.schedule = schedule;
                settings.timing = new RoundTiming { period = 0.12f, jitter = 0.05f };
                settings.network = new NetworkModel { loss = 0.2, lossPerMetre = 0.1, delay = 0.02, jitter = 0.1, retention = 0.3 };
            };
            var once = Digests(With(1), 0);
            foreach (var threads in new[] { 1, 2, 4, 8 }) Assert.That(Digests(With(threads), 0), Is.EqualTo(once), threads + " threads");
        }

        [TestCase(1, false)]
        [TestCase(4, true)]
        public void Reloading_the_same_programs_does_not_change_the_digests(int threads, bool isLossy)
        {
            Action<SimulationSettings> settings = changed =>
            {
                changed.threads = threads;
                if (isLossy) changed.network = new NetworkModel { loss = 0.2, delay = 0.02, jitter = 0.1, retention = 0.3 };
            };
            Assert.That(Digests(settings, 0, tick => tick % 3 == 0), Is.EqualTo(Digests(settings, 0)));
        }

        [Test]
        public void Different_seeds_give_different_digests()
        {
            Assert.That(Digests(settings => settings.seed = 2, 0), Is.Not.EqualTo(Digests(settings => settings.seed = 1, 0)));
        }

        [Test]
        public void A_flipped_sensor_bit_changes_the_digests_from_its_tick_on()
        {
            const int flipped = 5;
            var plain = Digests(null, 0);
            var other = Digests(null, flipped);
            for (var tick = 1; tick <= Ticks; tick++)
            {
                if (tick < flipped) Assert.That(other[tick - 1], Is.EqualTo(plain[tick - 1]), "tick " + tick);
                else Assert.That(other[tick - 1], Is.Not.EqualTo(plain[tick - 1]), "tick " + tick);
            }
        }

        /// <summary>Returns the digest after each tick of a small swarm that moves at random. In the tick `flipAt`, the last bit of a sensor flips.</summary>
        private List<ulong> Digests(Action<SimulationSettings> change, int flipAt, Predicate<int> isReloaded = null)
        {
            StopPlaying();
            StartPlaying();
            Configure("random", change);
            var nodes = new List<ProbeNode>();
            for (var i = 0; i < 40; i++)
            {
                var place = new Vector3(Manager.Random.Range(0f, 10f), 0, Manager.Random.Range(0f, 10f));
                nodes.Add(MakeNode(i + 1, place));
                nodes[i].Node.Program = i % 4 == 0 ? "scaled" : i % 4 == 1 ? "random" : i % 4 == 2 ? "sum" : "far";
                nodes[i].Node.gameObject.AddComponent<RadiusNeighbourhood>().Radius = 2;
            }
            Rejoin(nodes);
            var digests = new List<ulong>();
            for (var tick = 1; tick <= Ticks; tick++)
            {
                if (tick == flipAt) nodes[4].Sensor.Value = BitConverter.Int32BitsToSingle(BitConverter.SingleToInt32Bits(nodes[4].Sensor.Value) ^ 1);
                if (isReloaded != null && isReloaded(tick)) Manager.ReloadPrograms();
                Play(1);
                if (tick == flipAt) nodes[4].Sensor.Value = 5;
                foreach (var node in nodes) node.Node.transform.position += new Vector3(node.Node.Random.Range(-0.5f, 0.5f), 0, 0);
                digests.Add(Manager.Digest);
            }
            Assert.That(Errors, Is.Empty);
            return digests;
        }

        /// <summary>Lets the nodes join again, because nodes read their programs when they join.</summary>
        private static void Rejoin(List<ProbeNode> nodes)
        {
            foreach (var node in nodes)
            {
                node.Node.RequestedId = node.Node.Id;
                node.Node.enabled = false;
                node.Node.enabled = true;
            }
        }
    }
}
