using System;
using System.Collections.Generic;
using System.Diagnostics;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Components
{
    /// <summary>Compares the grid with a linear scan.</summary>
    [TestFixture]
    public sealed class NodeGridTests
    {
        private readonly List<Node> nodes = new List<Node>();
        private readonly NodeGrid grid = new NodeGrid();

        [SetUp]
        public void StartPlaying()
        {
            Loop.Reset();
            Loop.Start(1);
            nodes.Clear();
        }

        [TearDown]
        public void StopPlaying() => Loop.Reset();

        [TestCase(1, 1f, 1f)]
        [TestCase(300, 3f, 3f)]
        [TestCase(300, 3f, 1f)]
        [TestCase(300, 1f, 7f)]
        [TestCase(1000, 2.5f, 2.5f)]
        public void Find_returns_exactly_the_nodes_within_the_radius(int count, float cell, float radius)
        {
            var random = new RandomStream(3, 0, RandomPurpose.Scene);
            for (var i = 0; i < count; i++) Make(new Vector3(random.Range(-20f, 20f), random.Range(-2f, 2f), random.Range(-20f, 20f)));
            grid.Build(nodes, cell);
            for (var probe = 0; probe < 50; probe++)
            {
                var centre = new Vector3(random.Range(-22f, 22f), random.Range(-2f, 2f), random.Range(-22f, 22f));
                Assert.That(Found(centre, radius), Is.EquivalentTo(NearTo(centre, radius)));
            }
        }

        /// <summary>Enough rows of cells that some wrap around after the last bucket, and some share a bucket.</summary>
        [Test]
        public void Find_matches_brute_force_around_each_of_2000_nodes()
        {
            const float radius = 1.5f;
            var random = new RandomStream(6, 0, RandomPurpose.Scene);
            var places = new Vector3[2000];
            for (var i = 0; i < places.Length; i++)
            {
                places[i] = new Vector3(random.Range(-7f, 7f), random.Range(-7f, 7f), random.Range(-7f, 7f));
                Make(places[i]);
            }
            grid.Build(nodes, 0.5f);
            for (var i = 0; i < places.Length; i++)
            {
                var near = Array.FindAll(places, place => (place - places[i]).sqrMagnitude <= radius * radius).Length;
                Assert.That(grid.Find(places[i], radius).Length, Is.EqualTo(near), "around node " + i);
            }
        }

        [Test]
        public void All_nodes_at_one_point_are_found()
        {
            for (var i = 0; i < 200; i++) Make(new Vector3(5, 0, 5));
            grid.Build(nodes, 3);
            Assert.That(Found(new Vector3(5, 0, 5), 0.001f).Count, Is.EqualTo(200));
            Assert.That(Found(new Vector3(9, 0, 5), 3).Count, Is.EqualTo(0));
        }

        [TestCase(1, 3, 1f)]
        [TestCase(300, 1, 3f)]
        [TestCase(300, 8, 0.1f)]
        [TestCase(300, 8, 50f)]
        [TestCase(300, 400, 3f)]
        public void FindNearest_returns_the_nearest_nodes_in_order_for_any_initial_radius(int count, int wanted, float guess)
        {
            var random = new RandomStream(4, 0, RandomPurpose.Scene);
            for (var i = 0; i < count; i++) Make(new Vector3(random.Range(-20f, 20f), 0, random.Range(-20f, 20f)));
            grid.Build(nodes, 2);
            for (var probe = 0; probe < 20; probe++)
            {
                var centre = new Vector3(random.Range(-30f, 30f), random.Range(-2f, 2f), random.Range(-30f, 30f));
                var sorted = new List<Node>(nodes);
                sorted.Sort((a, b) => DistanceTo(centre, a).CompareTo(DistanceTo(centre, b)));
                Assert.That(Nearest(centre, wanted, guess), Is.EqualTo(sorted.GetRange(0, Math.Min(wanted, count))));
            }
        }

        [Test]
        public void FindNearest_prefers_lower_ids_at_equal_distances()
        {
            for (var i = 0; i < 50; i++) Make(Vector3.one, 50 - i);
            grid.Build(nodes, 1);
            var found = grid.FindNearest(Vector3.one, 3, 1);
            Assert.That(new[] { found[0].Id, found[1].Id, found[2].Id }, Is.EqualTo(new[] { 1, 2, 3 }));
        }

        [Test]
        public void Nodes_at_extreme_coordinates_are_found()
        {
            var far = new Vector3(1e12f, 0, -1e12f);
            Make(far);
            Make(Vector3.zero);
            Make(Vector3.right);
            grid.Build(nodes, 1);
            Assert.That(Found(far, 1), Is.EqualTo(new[] { nodes[0] }));
            Assert.That(Found(Vector3.zero, 1).Count, Is.EqualTo(2));
            Assert.That(Found(Vector3.zero, float.PositiveInfinity).Count, Is.EqualTo(3));
        }

        [Test]
        public void The_mean_radius_is_the_mean_of_valid_searches()
        {
            Make(Vector3.zero);
            grid.Build(nodes, 5);
            Assert.That(grid.MeanRadius, Is.EqualTo(5), "before any search");
            grid.Find(Vector3.zero, 1);
            grid.Find(Vector3.zero, 1);
            grid.Find(Vector3.zero, 4);
            Assert.That(grid.MeanRadius, Is.EqualTo(2));
            Assert.That(Found(Vector3.zero, float.NaN), Is.Empty);
            Assert.That(Found(Vector3.zero, -4), Is.Empty);
            Assert.That(grid.MeanRadius, Is.EqualTo(2), "an invalid radius does not count");
        }

        /// <summary>For the linear scan, the same grid gets cells so small that a search visits all nodes.</summary>
        [TestCase(500, false, 2)]
        [TestCase(500, true, 2)]
        [TestCase(5000, false, 10)]
        [TestCase(5000, true, 10)]
        [TestCase(20000, false, 20)]
        [TestCase(20000, true, 20)]
        public void A_search_is_several_times_faster_than_a_linear_scan(int count, bool nearest, int times)
        {
            var random = new RandomStream(5, 0, RandomPurpose.Scene);
            var side = (float)Math.Sqrt(count);
            for (var i = 0; i < count; i++) Make(new Vector3(random.Range(0, side), 0, random.Range(0, side)));
            var all = Search(1e-3f, nearest);
            var few = Search(2, nearest);
            Console.WriteLine("  " + count + " nodes: " + few.ToString("0.00") + " us per search, " + all.ToString("0.00") + " us for a linear scan");
            Assert.That(few * times, Is.LessThan(all));
        }

        /// <returns>Microseconds per search, in the fastest of ten batches.</returns>
        private double Search(float cell, bool nearest)
        {
            grid.Build(nodes, cell);
            var best = double.MaxValue;
            for (var turn = 0; turn < 10; turn++)
            {
                var clock = Stopwatch.StartNew();
                for (var i = 0; i < 200; i++)
                {
                    var place = nodes[i * (nodes.Count / 200)].transform.position;
                    if (nearest) grid.FindNearest(place, 8, 2);
                    else grid.Find(place, 2);
                }
                best = Math.Min(best, clock.Elapsed.TotalMilliseconds * 1000 / 200);
            }
            return best;
        }

        private static float DistanceTo(Vector3 centre, Node node) => (node.transform.position - centre).magnitude;

        private List<Node> Nearest(Vector3 centre, int wanted, float guess)
        {
            var found = new List<Node>();
            var hits = grid.FindNearest(centre, wanted, guess);
            for (var i = 0; i < hits.Length; i++) found.Add(grid.NodeAt(hits[i]));
            return found;
        }

        private void Make(Vector3 place, int id)
        {
            Make(place);
            nodes[nodes.Count - 1].OnJoined(new Collektive.Unity.Simulation(new SimulationSettings(), new SceneGlobals(), null), id);
        }

        private void Make(Vector3 place)
        {
            var holder = new GameObject("Node");
            holder.transform.position = place;
            nodes.Add(holder.AddComponent<Node>());
        }

        private List<Node> Found(Vector3 centre, float radius)
        {
            var found = new List<Node>();
            var hits = grid.Find(centre, radius);
            for (var i = 0; i < hits.Length; i++) found.Add(grid.NodeAt(hits[i]));
            return found;
        }

        private List<Node> NearTo(Vector3 centre, float radius) =>
            nodes.FindAll(node => (node.transform.position - centre).sqrMagnitude <= radius * radius);
    }
}
