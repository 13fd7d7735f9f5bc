using System;
using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Components
{
    /// <summary>Compares searches for nodes with a linear scan. The C tests compare many more cases.</summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class NodeGridTests
    {
        private readonly List<Node> nodes = new List<Node>();
        private Collektive.Unity.Simulation simulation;
        private NeighbourSearch search;
        private NodeGrid grid;

        [SetUp]
        public void StartPlaying()
        {
            Loop.Reset();
            Loop.Start(1);
            nodes.Clear();
            simulation = new Collektive.Unity.Simulation(new SimulationSettings(), new SceneGlobals(), null);
            search = new NeighbourSearch();
            grid = new NodeGrid(search);
        }

        [TearDown]
        public void StopPlaying()
        {
            search.Dispose();
            Loop.Reset();
        }

        [TestCase(1, 1f, 1f)]
        [TestCase(300, 3f, 1f)]
        [TestCase(300, 1f, 7f)]
        [TestCase(1000, 0f, 2.5f)]
        public void Find_returns_the_nodes_within_the_radius_by_id(int count, float cell, float radius)
        {
            var random = new RandomStream(3, 0, RandomPurpose.Scene);
            Scatter(count, random);
            grid.Build(nodes.ToArray(), count, cell);
            for (var probe = 0; probe < 50; probe++)
            {
                var centre = new Vector3(random.Range(-22f, 22f), random.Range(-2f, 2f), random.Range(-22f, 22f));
                Assert.That(NodesOf(grid.Find(centre, radius)), Is.EqualTo(NearTo(centre, radius)));
            }
        }

        [TestCase(1, 3, 1f)]
        [TestCase(300, 8, 0f)]
        [TestCase(300, 400, 3f)]
        public void FindNearest_returns_the_nearest_nodes_in_order_for_any_guess(int count, int limit, float guess)
        {
            var random = new RandomStream(4, 0, RandomPurpose.Scene);
            Scatter(count, random);
            grid.Build(nodes.ToArray(), count, 2);
            for (var probe = 0; probe < 20; probe++)
            {
                var centre = new Vector3(random.Range(-30f, 30f), random.Range(-2f, 2f), random.Range(-30f, 30f));
                var sorted = new List<Node>(nodes);
                sorted.Sort((a, b) => DistanceTo(centre, a).CompareTo(DistanceTo(centre, b)));
                Assert.That(NodesOf(grid.FindNearest(centre, limit, guess)), Is.EqualTo(sorted.GetRange(0, Math.Min(limit, count))));
            }
        }

        [Test]
        public void FindNearest_prefers_lower_ids_at_equal_distances()
        {
            for (var i = 0; i < 50; i++) Make(Vector3.one);
            grid.Build(nodes.ToArray(), 50);
            Assert.That(NodesOf(grid.FindNearest(Vector3.one, 3, 1)), Is.EqualTo(nodes.GetRange(0, 3)));
            Assert.That(grid.FindNearest(Vector3.one, 0, 1).Length, Is.EqualTo(0));
            Assert.That(grid.FindNearest(Vector3.one, -1, 1).Length, Is.EqualTo(0));
        }

        [Test]
        public void Nodes_at_extreme_coordinates_are_found()
        {
            var far = new Vector3(1e12f, 0, -1e12f);
            Make(far);
            Make(Vector3.zero);
            Make(Vector3.right);
            grid.Build(nodes.ToArray(), 3, 1);
            Assert.That(NodesOf(grid.Find(far, 1)), Is.EqualTo(new[] { nodes[0] }));
            Assert.That(grid.Find(Vector3.zero, 1).Length, Is.EqualTo(2));
            Assert.That(grid.Find(Vector3.zero, float.PositiveInfinity).Length, Is.EqualTo(3));
            Assert.That(grid.Find(Vector3.zero, float.NaN).Length, Is.EqualTo(0));
            Assert.That(grid.Find(Vector3.zero, -4).Length, Is.EqualTo(0));
        }

        [Test]
        public void A_position_that_is_not_finite_is_an_error_of_its_node()
        {
            Make(Vector3.zero);
            Make(new Vector3(3e38f, 0, 0));
            var parent = new GameObject("Parent");
            nodes[1].transform.SetParent(parent.transform, true);
            parent.transform.localScale = new Vector3(10, 1, 1);
            Assert.That(() => grid.Build(nodes.ToArray(), 2), Throws.InstanceOf<BridgeException>().With.Message.StartsWith(
                "the position of node 1 ('Node') is not finite, "));
        }

        [Test]
        public void Without_points_nothing_is_found()
        {
            Assert.That(grid.Find(Vector3.zero, 1).Length + grid.FindNearest(Vector3.zero, 1, 1).Length, Is.EqualTo(0), "before the first points are set");
            Make(Vector3.zero);
            grid.Build(nodes.ToArray(), 1);
            Assert.That(grid.Find(Vector3.zero, 1).Length, Is.EqualTo(1));
            search.Dispose();
            search.Dispose();
            Assert.That(grid.Find(Vector3.zero, 1).Length + grid.FindNearest(Vector3.zero, 1, 1).Length, Is.EqualTo(0), "after the simulation has ended");
        }

        private static float DistanceTo(Vector3 centre, Node node) => (node.transform.position - centre).magnitude;

        private void Scatter(int count, RandomStream random)
        {
            for (var i = 0; i < count; i++) Make(new Vector3(random.Range(-20f, 20f), random.Range(-2f, 2f), random.Range(-20f, 20f)));
        }

        private void Make(Vector3 place)
        {
            var holder = new GameObject("Node");
            holder.transform.position = place;
            nodes.Add(holder.AddComponent<Node>());
            nodes[nodes.Count - 1].OnJoined(simulation, nodes.Count - 1);
        }

        private List<Node> NodesOf(Span<NearNode> hits)
        {
            var found = new List<Node>();
            for (var i = 0; i < hits.Length; i++) found.Add(grid.NodeAt(hits[i]));
            return found;
        }

        private List<Node> NearTo(Vector3 centre, float radius) =>
            nodes.FindAll(node => (node.transform.position - centre).sqrMagnitude <= radius * radius);
    }
}
