using System;
using System.Collections.Generic;
using System.Threading;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Components
{
    /// <summary>Searches on the second thread return the same results as those on the main thread.</summary>
    [TestFixture]
    public sealed class BackgroundSearchTests
    {
        private const int Count = 600;

        private readonly List<Node> nodes = new List<Node>();
        private readonly RandomStream random = new RandomStream(7, 0, RandomPurpose.Scene);
        private NodeGrid grid;

        [SetUp]
        public void StartPlaying()
        {
            Loop.Reset();
            Loop.Start(1);
            nodes.Clear();
            grid = new NodeGrid();
            for (var i = 0; i < Count; i++)
            {
                nodes.Add(new GameObject("Node").AddComponent<Node>());
                Move(nodes[i]);
            }
        }

        [TearDown]
        public void StopPlaying()
        {
            grid.Dispose();
            Loop.Reset();
        }

        [Test]
        public void Results_equal_those_of_a_search_on_the_main_thread()
        {
            using (var alone = new NodeGrid())
            {
                for (var tick = 0; tick < 60; tick++)
                {
                    for (var moves = 0; moves < 50; moves++) Move(nodes[(int)random.Range(0f, nodes.Count)]);
                    // The last node takes the index of a removed one.
                    if (tick % 10 == 0)
                    {
                        nodes[tick] = nodes[nodes.Count - 1];
                        nodes.RemoveAt(nodes.Count - 1);
                    }
                    var radius = tick % 7 == 0 ? 1.5f : 3;
                    grid.Build(nodes, 3, true);
                    // Vary how far the second thread gets in each tick.
                    if (tick % 3 == 0) Thread.Sleep(1);
                    var found = new List<(int, float)>[nodes.Count];
                    for (var i = 0; i < nodes.Count; i++) found[i] = Hits(grid.FindAround(nodes[i], radius));
                    alone.Build(nodes, 3);
                    for (var i = 0; i < nodes.Count; i++)
                        Assert.That(found[i], Is.EqualTo(Hits(alone.Find(nodes[i].Position, radius))), "node " + i + " in tick " + tick);
                    Assert.That(grid.MeanRadius, Is.EqualTo(radius).Within(1e-5), "searches of both threads count");
                }
            }
        }

        [Test]
        public void Each_search_uses_the_last_radius_of_its_node()
        {
            grid.Build(nodes, 3);
            for (var i = 0; i < Count; i++) grid.FindAround(nodes[i], i % 2 == 0 ? 2 : 4);
            grid.Build(nodes, 3);
            using (var ahead = new BackgroundSearch(grid))
            {
                var taken = false;
                for (var patience = 1; !taken && patience < 10000; patience *= 2)
                {
                    ahead.Begin(Count);
                    Thread.Sleep(patience);
                    taken = ahead.TryTake(1, out var near);
                    if (taken) Assert.That(Hits(near), Is.EqualTo(Hits(grid.Find(nodes[1].Position, 4))));
                    for (var i = 2; taken && i < Count; i++)
                    {
                        Assert.That(ahead.TryTake(i, out near), "node " + i);
                        Assert.That(Hits(near), Is.EqualTo(Hits(grid.Find(nodes[i].Position, i % 2 == 0 ? 2 : 4))), "node " + i);
                    }
                    ahead.End();
                }
                Assert.That(taken, "no result within ten seconds");
                Assert.That(ahead.TryTake(5, out _), Is.False, "after its end");
            }
        }

        [Test]
        public void An_exception_on_the_search_thread_is_rethrown_once_on_the_main_thread()
        {
            grid.Build(nodes, 3);
            using (var ahead = new BackgroundSearch(grid))
            {
                ahead.Begin(100000);
                Thread.Sleep(50);
                Assert.That(ahead.End, Throws.InvalidOperationException.With.InnerException.InstanceOf<IndexOutOfRangeException>());
                ahead.End();
            }
        }

        [Test]
        public void The_grid_can_be_disposed_during_a_search_and_used_again()
        {
            for (var turn = 0; turn < 50; turn++)
            {
                grid.Build(nodes, 3, true);
                for (var i = 0; i < turn; i++) grid.FindAround(nodes[i], 3);
                grid.Dispose();
                grid.Dispose();
                Assert.That(grid.FindAround(nodes[0], 3).Length, Is.GreaterThan(0));
            }
        }

        private void Move(Node node) => node.transform.position = new Vector3(random.Range(-20f, 20f), random.Range(-1f, 1f), random.Range(-20f, 20f));

        private static List<(int, float)> Hits(Span<NearNode> near)
        {
            var hits = new List<(int, float)>();
            for (var i = 0; i < near.Length; i++) hits.Add((near[i].Place, near[i].Distance));
            return hits;
        }
    }
}
