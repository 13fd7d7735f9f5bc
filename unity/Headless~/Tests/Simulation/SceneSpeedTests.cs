using System;
using System.Collections.Generic;
using System.Reflection;
using Collektive.Bridge;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>
    /// Tests how much processor time parts of the package need on the main thread, in a dense scene of 1,000 nodes on a plane. The limits are for Mono, and
    /// each of them fits into one frame.
    /// </summary>
    [TestFixture]
    [Category("Slow")]
    public sealed class SceneSpeedTests : SimulationFixture
    {
        private const int Count = 1000;
        private const int Tries = 60;

        [TearDown]
        public void CloseWindow()
        {
            EditorApplication.isPlaying = false;
            DiagnosticsWindow.Open().Close();
        }

        [Test, Category("Repeats")]
        public void Trigger_rules_of_95_neighbours_take_less_than_10_milliseconds_a_tick()
        {
            // On this plane of 10 m by 10 m, each node has about 95 others within 1.8 m.
            Scatter(Count, 10, node =>
            {
                node.AddComponent<SphereCollider>().radius = 0.05f;
                node.AddComponent<Rigidbody>().isKinematic = true;
                var zone = new GameObject("Zone");
                zone.transform.SetParent(node.transform, false);
                var trigger = zone.AddComponent<SphereCollider>();
                trigger.isTrigger = true;
                trigger.radius = 1.8f;
                zone.AddComponent<TriggerNeighbourhood>();
            });
            Play(3);
            var milliseconds = ShortestRuleUpdate(() => { });
            Print("trigger rules, " + Manager.LinkCount + " links", milliseconds);
            Assert.That(Errors, Is.Empty);
            Assert.That(Manager.LinkCount, Is.GreaterThan(80 * Count));
            Assert.That(milliseconds, Is.LessThan(10));
        }

        [Test]
        public void Rules_of_10_000_moving_nodes_take_less_than_8_milliseconds_a_tick()
        {
            // The nodes are about 2 m apart, have seven neighbours each, and move at 2 m/s.
            ScatterInRadius(10 * Count, 200, 3);
            Play(1);
            var random = new RandomStream(5, 0, RandomPurpose.Scene);
            var ways = new Vector3[10 * Count];
            for (var i = 0; i < ways.Length; i++) ways[i] = Quaternion.Euler(0, random.Range(0f, 360f), 0) * new Vector3(0, 0, 0.1f);
            var milliseconds = ShortestRuleUpdate(() =>
            {
                for (var i = 0; i < ways.Length; i++) Manager.Nodes[i].transform.position += ways[i];
            });
            Print("rules of 10,000 moving nodes, " + Manager.LinkCount + " links", milliseconds);
            Assert.That(Manager.LinkCount, Is.InRange(60 * Count, 80 * Count));
            // An idle machine takes far less than this limit.
            Assert.That(milliseconds, Is.LessThan(8));
        }

        [TestCase(LinkColouring.Direction)]
        [TestCase(LinkColouring.Length)]
        public void The_link_view_of_83_000_links_takes_2_milliseconds_a_tick(LinkColouring colouring)
        {
            var view = new GameObject("Links").AddComponent<LinkView>();
            view.Colouring = colouring;
            ScatterInRadius(Count, 10, 1.75f);
            Play(1);
            var milliseconds = LeastOfView(view);
            Print("link view by " + colouring + ", " + Manager.LinkCount + " links", milliseconds);
            Assert.That(Manager.LinkCount, Is.InRange(75000, 90000));
            Assert.That(milliseconds, Is.LessThan(3));
        }

        [Test]
        public void The_link_view_of_10_000_nodes_stays_within_its_budget()
        {
            var view = new GameObject("Links").AddComponent<LinkView>();
            ScatterInRadius(10 * Count, 31.6f, 1.75f);
            Play(1);
            var milliseconds = LeastOfView(view);
            Print("link view within its limit, " + Manager.LinkCount + " links", milliseconds);
            Assert.That(Manager.LinkCount, Is.GreaterThan(750000));
            Assert.That(milliseconds, Is.LessThan(3));
            view.Limit = int.MaxValue;
            Print("link view without a limit, " + Manager.LinkCount + " links", LeastOfView(view));
        }

        [Test]
        public void Line_of_sight_rules_cast_each_pair_once()
        {
            Scatter(Count, 30, node => node.AddComponent<LineOfSightNeighbourhood>().Radius = 2);
            for (var i = 0; i < 100; i++)
            {
                var wall = GameObject.CreatePrimitive(PrimitiveType.Cube);
                wall.transform.position = new Vector3(3 * (i % 10) + 1, 0, 3 * (i / 10) + 1);
                wall.transform.localScale = new Vector3(0.2f, 1, 1);
            }
            Play(2);
            Print("line of sight rules, " + Manager.LinkCount + " links", ShortestRuleUpdate(() => { }));
            var before = QueryLog.Rays;
            Manager.Step();
            Assert.That(QueryLog.Rays - before, Is.EqualTo(PairsWithin(2)));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Sensors_of_1_000_nodes_with_8_rays_and_obstacles_are_timed()
        {
            Scatter(Count, 40, node =>
            {
                node.AddComponent<SphereCollider>().radius = 0.3f;
                node.AddComponent<SensorTests.Rays>().Rays = 8;
                node.AddComponent<SensorTests.Obstacles>().Reach = 2;
            });
            Play(2);
            var best = double.MaxValue;
            for (var i = 0; i < Tries; i++)
            {
                Manager.Step();
                best = Math.Min(best, Manager.Times.Sense);
            }
            Print("8 rays and a sphere of " + Count + " nodes", best);
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void The_diagnostics_window_takes_less_than_half_a_millisecond_per_event()
        {
            EditorApplication.isPlaying = true;
            ScatterInRadius(Count, 10, 1.75f);
            Play(1);
            var window = DiagnosticsWindow.Open();
            var milliseconds = ThreadClock.Least(Tries, () =>
            {
                Gui.Clear();
                Menus.Draw(window);
            });
            Print("diagnostics window, an event", milliseconds);
            var first = ThreadClock.Least(Tries, () =>
            {
                Gui.Clear();
                Menus.Send(window, "OnInspectorUpdate");
                Menus.Draw(window);
            });
            Print("diagnostics window, the first event after a tenth of a second", first);
            Assert.That(milliseconds, Is.LessThan(0.5));
            // The first event takes longer, because it reads the list of nodes again.
            Assert.That(first, Is.LessThan(2));
        }

        [Test]
        public void Leaving_and_joining_of_10_000_nodes_is_timed()
        {
            const int count = 10 * Count;
            var nodes = new Node[count];
            for (var i = 0; i < count; i++) nodes[i] = new GameObject("Node").AddComponent<Node>();
            Play(1);
            var start = ThreadClock.Milliseconds;
            for (var i = 0; i < count; i++) nodes[i * 7919 % count].enabled = false;
            var leaving = ThreadClock.Milliseconds - start;
            Print(count + " nodes leave", leaving);
            start = ThreadClock.Milliseconds;
            foreach (var node in nodes) node.enabled = true;
            Play(1);
            Print(count + " nodes join", ThreadClock.Milliseconds - start);
            Assert.That(Manager.Nodes.Count, Is.EqualTo(count));
        }

        private static void Scatter(int count, float side, Action<GameObject> equip)
        {
            var random = new RandomStream(9, 0, RandomPurpose.Scene);
            for (var i = 0; i < count; i++)
            {
                var node = new GameObject("Node");
                node.SetActive(false);
                node.transform.position = new Vector3(random.Range(0f, side), 0, random.Range(0f, side));
                node.AddComponent<Node>();
                equip(node);
                node.SetActive(true);
            }
        }

        private static void ScatterInRadius(int count, float side, float radius) =>
            Scatter(count, side, node => node.AddComponent<RadiusNeighbourhood>().Radius = radius);

        private int PairsWithin(float radius)
        {
            var pairs = 0;
            for (var i = 0; i < Manager.Nodes.Count; i++)
            {
                for (var j = 0; j < i; j++)
                {
                    if ((Manager.Nodes[i].Position - Manager.Nodes[j].Position).sqrMagnitude <= radius * radius) pairs++;
                }
            }
            return pairs;
        }

        /// <summary>Returns the milliseconds that the rules take in the fastest of several ticks. Runs an action before each tick.</summary>
        private double ShortestRuleUpdate(Action before)
        {
            var best = double.MaxValue;
            for (var i = 0; i < Tries; i++)
            {
                before();
                Manager.Step();
                best = Math.Min(best, Manager.Times.Rules);
            }
            return best;
        }

        /// <summary>Returns the milliseconds that the view's LateUpdate takes after a tick in which all links are new.</summary>
        private double LeastOfView(LinkView view)
        {
            var frame = (Action)typeof(LinkView).GetMethod("LateUpdate", BindingFlags.Instance | BindingFlags.NonPublic).CreateDelegate(typeof(Action), view);
            var best = double.MaxValue;
            for (var i = 0; i < Tries; i++)
            {
                Manager.Step();
                var start = ThreadClock.Milliseconds;
                frame();
                best = Math.Min(best, ThreadClock.Milliseconds - start);
            }
            return best;
        }

        private static void Print(string what, double milliseconds) => Console.WriteLine("  " + what + ": " + milliseconds.ToString("0.00") + " ms");
    }
}
