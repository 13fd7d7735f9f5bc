using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Components
{
    /// <summary>The grid against looking at every node.</summary>
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
        public void It_finds_exactly_the_nodes_within_the_radius(int count, float cell, float radius)
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

        [Test]
        public void All_nodes_at_one_point_are_found()
        {
            for (var i = 0; i < 200; i++) Make(new Vector3(5, 0, 5));
            grid.Build(nodes, 3);
            Assert.That(Found(new Vector3(5, 0, 5), 0.001f).Count, Is.EqualTo(200));
            Assert.That(Found(new Vector3(9, 0, 5), 3).Count, Is.EqualTo(0));
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
