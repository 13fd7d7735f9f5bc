using System;
using System.Collections;
using System.Collections.Generic;
using System.Reflection;
using System.Threading;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;
using Object = UnityEngine.Object;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests that leaving play mode releases all resources in any situation.</summary>
    [TestFixture]
    public sealed class PlayModeTests : SimulationFixture
    {
        private const int Times = 50;

        // After the first query of the JVM's status, one slot stays in use for the answers.
        private int slotsBefore;

        [SetUp]
        public void CountSlots() => slotsBefore = ShimCounts.Slots;

        [Test]
        public void Fifty_plays_do_not_leak_sessions_slots_threads_or_objects()
        {
            var managers = new List<WeakReference>();
            var threads = 0;
            for (var i = 0; i < Times; i++)
            {
                PlayOnce(managers);
                Assert.That(ShimCounts.Sessions, Is.EqualTo(0), "play " + i);
                Assert.That(ShimCounts.Slots, Is.EqualTo(slotsBefore), "play " + i);
                if (i == 10) threads = CountThreadsAfterDelay();
            }
            Assert.That(CountThreadsAfterDelay(), Is.LessThanOrEqualTo(threads + 2));
            GC.Collect();
            GC.WaitForPendingFinalizers();
            GC.Collect();
            var alive = managers.FindAll(manager => manager.IsAlive).Count;
            // A few objects may survive, because the garbage collectors scan stacks conservatively.
            Assert.That(alive, Is.LessThan(5));
        }

        [Test]
        public void Leaving_play_mode_resets_all_static_fields()
        {
            StopPlaying();
            var before = Statics();
            StartPlaying();
            Configure("count");
            MakeNode(0);
            Play(2);
            StopPlaying();
            var after = Statics();
            foreach (var field in before.Keys) Assert.That(after[field], Is.EqualTo(before[field]), field);
        }

        [TestCase("manager")]
        [TestCase("own")]
        [TestCase("other")]
        [TestCase("all")]
        public void A_scene_can_be_destroyed_during_a_tick(string victim)
        {
            foreach (var place in new[] { "sensor", "actuator", "ticked" })
            {
                StopPlaying();
                StartPlaying();
                Configure("count");
                var nodes = new List<ProbeNode>();
                for (var i = 0; i < 5; i++) nodes.Add(MakeNode(0));
                var killer = nodes[2].Node.gameObject;
                Action kill = () => Destroy(victim, killer, nodes);
                Play(2);
                if (place == "sensor") killer.AddComponent<KillingSensor>().Kill = kill;
                if (place == "actuator") killer.AddComponent<KillingActuator>().Kill = kill;
                if (place == "ticked") Manager.Ticked += _ => kill();
                Play(3);
                Assert.That(Errors, Is.Empty, place);
                StopPlaying();
                Assert.That(ShimCounts.Sessions, Is.EqualTo(0), place);
                Assert.That(ShimCounts.Slots, Is.EqualTo(slotsBefore), place);
            }
            StartPlaying();
        }

        [Test]
        public void A_scene_can_be_destroyed_in_any_order()
        {
            var random = new System.Random(1);
            for (var round = 0; round < 20; round++)
            {
                StopPlaying();
                StartPlaying();
                Configure("sum");
                var victims = new List<GameObject> { Manager.gameObject };
                for (var i = 0; i < 8; i++)
                {
                    var node = MakeNode(1, new Vector3(i, 0, 0));
                    node.Node.gameObject.AddComponent<RadiusNeighbourhood>().Radius = 2;
                    victims.Add(node.Node.gameObject);
                }
                Play(2);
                while (victims.Count > 0)
                {
                    var index = random.Next(victims.Count);
                    Object.DestroyImmediate(victims[index]);
                    victims.RemoveAt(index);
                    if (random.Next(2) == 0) Loop.Frame(0.05f);
                }
                Assert.That(Errors, Is.Empty, "round " + round);
                Assert.That(ShimCounts.Sessions, Is.EqualTo(0), "round " + round);
                Assert.That(ShimCounts.Slots, Is.EqualTo(slotsBefore), "round " + round);
            }
        }

        [Test]
        public void A_session_that_was_not_closed_is_closed_by_the_garbage_collector()
        {
            var forgotten = new List<WeakReference>();
            ForgetSessions(forgotten);
            for (var i = 0; i < 50 && ShimCounts.Sessions > 1; i++)
            {
                GC.Collect();
                GC.WaitForPendingFinalizers();
                Thread.Sleep(10);
            }
            var left = ShimCounts.Sessions;
            foreach (var session in forgotten) (session.Target as Session)?.Dispose();
            // A few objects may survive, because the garbage collectors scan stacks conservatively.
            Assert.That(left, Is.LessThanOrEqualTo(1));
        }

        [Test]
        public void Nothing_runs_in_edit_mode()
        {
            foreach (var type in typeof(SimulationManager).Assembly.GetTypes())
            {
                Assert.That(type.IsDefined(typeof(ExecuteAlways), true) || type.IsDefined(typeof(ExecuteInEditMode), true), Is.False, type.Name);
            }
        }

        private void PlayOnce(List<WeakReference> managers)
        {
            StopPlaying();
            StartPlaying();
            Configure("count");
            var node = MakeNode(0);
            Play(2);
            Assert.That(node.Answer, Is.EqualTo(2));
            managers.Add(new WeakReference(Manager));
            StopPlaying();
        }

        private static void ForgetSessions(List<WeakReference> forgotten)
        {
            for (var i = 0; i < 10; i++)
            {
                var session = TestJvm.Open("double");
                forgotten.Add(new WeakReference(session));
                TestJvm.Tick(session);
            }
        }

        /// <summary>Counts the threads after a delay, because threads that run rounds end shortly after their session.</summary>
        private static int CountThreadsAfterDelay()
        {
            Thread.Sleep(200);
            return ShimCounts.Threads;
        }

        private void Destroy(string victim, GameObject killer, List<ProbeNode> nodes)
        {
            if (victim == "manager" || victim == "all") Object.DestroyImmediate(Manager.gameObject);
            if (victim == "own") Object.Destroy(killer);
            if (victim == "other") Object.DestroyImmediate(nodes[3].Node == null ? null : nodes[3].Node.gameObject);
            if (victim != "all") return;
            foreach (var node in nodes)
            {
                if (node.Node != null && node.Node.gameObject != killer) Object.DestroyImmediate(node.Node.gameObject);
            }
        }

        /// <summary>Returns the values of the package's static fields, except the fields that users set.</summary>
        private static Dictionary<string, string> Statics()
        {
            var values = new Dictionary<string, string>();
            foreach (var assembly in new[] { typeof(SimulationManager).Assembly, typeof(Jvm).Assembly })
            {
                foreach (var type in assembly.GetTypes())
                {
                    if (type.ContainsGenericParameters || type == typeof(Installation)) continue;
                    foreach (var field in type.GetFields(BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly))
                    {
                        if (field.IsLiteral || field.Name.StartsWith("<>", StringComparison.Ordinal)) continue;
                        var value = field.GetValue(null);
                        values[type.FullName + "." + field.Name] = value is ICollection many ? many.Count + " elements" : value?.ToString() ?? "null";
                    }
                }
            }
            return values;
        }

        public sealed class KillingSensor : Sensor<probe.SensorData>
        {
            public Action Kill;

            protected override void Sense(ref probe.SensorData data) => Kill?.Invoke();
        }

        public sealed class KillingActuator : Actuator<probe.ActuatorData>
        {
            public Action Kill;

            protected override void Act(probe.ActuatorData data) => Kill?.Invoke();
        }
    }
}
