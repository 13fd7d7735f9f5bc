using System;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests that digests do not depend on orders that Unity does not specify.</summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class OrderTests : SimulationFixture
    {
        private const int Few = 5;
        private const int Many = 200;
        private const int Ticks = 12;

        [TestCase("Channel", "channel", "nodes", 120)]
        [TestCase("Crowd", "crowd", "walkers", 40)]
        [TestCase("GradientAscent", "gradient-ascent", "nodes", 60)]
        [TestCase("LeaderElection", "leader-election", "nodes", 80)]
        [TestCase("Rescue", "rescue", "robots", 20)]
        [TestCase("Swarm", "swarm", "drones", 150)]
        public void A_sample_has_one_digest_in_any_order(string sample, string program, string size, int count) =>
            AssertOne(Few, () => PlaySample(sample, program, size, count));

        [Test, Category("Repeats")]
        [TestCase("Channel", "channel", "nodes", 120)]
        [TestCase("Crowd", "crowd", "walkers", 40)]
        [TestCase("GradientAscent", "gradient-ascent", "nodes", 60)]
        [TestCase("LeaderElection", "leader-election", "nodes", 80)]
        [TestCase("Rescue", "rescue", "robots", 20)]
        [TestCase("Swarm", "swarm", "drones", 150)]
        public void A_sample_has_one_digest_in_200_orders(string sample, string program, string size, int count) =>
            AssertOne(Many, () => PlaySample(sample, program, size, count));

        [Test]
        public void Parts_and_touches_have_one_digest_in_any_order() => AssertOne(40, PlayTouches);

        [TestCase("2: 0 1", "0 1 2 3 4", "2 3 4")]
        [TestCase("1: 1 0", "0 1 2 3 4", "2 3 4")]
        [TestCase("1: 3 0", "0 1 2 4", "1 2 4")]
        public void A_part_that_disables_others_does_not_hide_later_parts(string disabling, string first, string second)
        {
            var node = new GameObject("Node");
            node.SetActive(false);
            node.AddComponent<Node>();
            var parts = new List<Named>();
            var names = new List<string>();
            for (var i = 0; i < 5; i++)
            {
                var name = i.ToString();
                parts.Add(node.AddComponent<Named>());
                parts[i].Sensed = () =>
                {
                    names.Add(name);
                    if (!disabling.StartsWith(name, StringComparison.Ordinal)) return;
                    foreach (var other in disabling.Substring(3).Split(' ')) parts[int.Parse(other)].enabled = false;
                };
            }
            node.SetActive(true);
            Play(1);
            Assert.That(string.Join(" ", names), Is.EqualTo(first));
            names.Clear();
            Play(1);
            Assert.That(string.Join(" ", names), Is.EqualTo(second));
        }

        [Test]
        public void Parts_run_in_the_order_of_their_components()
        {
            var order = new List<string>();
            for (var seed = 1; seed <= 20; seed++)
            {
                Loop.OrderSeed = seed;
                var node = new GameObject("Node");
                node.SetActive(false);
                node.AddComponent<Node>();
                var names = new List<string>();
                void Add(GameObject owner, string name) => owner.AddComponent<Named>().Sensed = () => names.Add(name);
                Add(node, "0");
                Add(node, "1");
                foreach (var name in new[] { "2", "4" })
                {
                    var arm = new GameObject(name);
                    arm.transform.SetParent(node.transform);
                    Add(arm, name);
                    if (name != "2") continue;
                    var hand = new GameObject("Hand");
                    hand.transform.SetParent(arm.transform);
                    Add(hand, "3");
                }
                node.SetActive(true);
                Play(1);
                order.Add(string.Join(" ", names));
                UnityEngine.Object.DestroyImmediate(node);
            }
            Assert.That(order, Has.All.EqualTo("0 1 2 3 4"));
        }

        private void AssertOne(int orders, Func<ulong> play)
        {
            var expected = Digest(0, play);
            for (var seed = 1; seed <= orders; seed++) Assert.That(Digest(seed, play), Is.EqualTo(expected), "order " + seed);
        }

        private ulong Digest(int seed, Func<ulong> play)
        {
            StopPlaying();
            StartPlaying();
            Loop.OrderSeed = seed;
            var digest = play();
            Assert.That(Errors, Is.Empty);
            Assert.That(Manager.Nodes.Count, Is.GreaterThan(1));
            return digest;
        }

        private ulong PlaySample(string sample, string program, string size, int count)
        {
            var samples = Assembly.LoadFrom(Path.Combine(AppDomain.CurrentDomain.BaseDirectory, "Collektive.Samples.dll"));
            var scene = samples.GetType("CollektiveSamples." + sample + "." + sample + "Scene", true);
            Configure(program, settings =>
            {
                settings.schema = Array.Find(samples.GetTypes(), type => type.Name == sample + "Schema").FullName;
                settings.jars = new List<string> { Path.Combine(TestJvm.Variable("COLLEKTIVE_ROOT"), "jvm-host/programs/target/collektive-programs.jar") };
                settings.deltaTime = 0.1f;
            });
            var holder = new GameObject("Scene");
            holder.SetActive(false);
            var builder = holder.AddComponent(scene);
            scene.GetField(size).SetValue(builder, count);
            scene.GetField("failAfter")?.SetValue(builder, 0.5f);
            holder.SetActive(true);
            Play(Ticks);
            return Manager.Digest;
        }

        /// <summary>Plays nodes that fall onto each other inside zones, and returns the digest. Several parts of the scene draw random numbers.</summary>
        private ulong PlayTouches()
        {
            Configure("sum");
            for (var i = 0; i < 12; i++)
            {
                var zone = new GameObject("Zone").AddComponent<SphereCollider>();
                zone.isTrigger = true;
                zone.radius = 2;
                zone.transform.position = new Vector3(i % 4, 0, i / 4);
            }
            var floor = GameObject.CreatePrimitive(PrimitiveType.Cube);
            floor.transform.position = new Vector3(0, -1, 0);
            floor.transform.localScale = new Vector3(50, 1, 50);
            for (var i = 0; i < 20; i++)
            {
                var holder = GameObject.CreatePrimitive(PrimitiveType.Sphere);
                holder.SetActive(false);
                holder.transform.position = new Vector3(i % 5 * 0.9f, 0.2f + 0.3f * (i / 5), i / 5 * 0.9f);
                holder.AddComponent<Rigidbody>();
                holder.AddComponent<Node>();
                var range = new GameObject("Range");
                range.transform.SetParent(holder.transform, false);
                range.AddComponent<SphereCollider>().radius = 2;
                range.GetComponent<SphereCollider>().isTrigger = true;
                range.AddComponent<TriggerNeighbourhood>();
                holder.AddComponent<Zones>();
                holder.AddComponent<Contacts>();
                holder.AddComponent<RandomPart>();
                holder.AddComponent<RandomPart>();
                holder.SetActive(true);
            }
            Play(Ticks);
            Assert.That(Manager.LinkCount, Is.GreaterThan(20));
            return Manager.Digest;
        }

        private sealed class Named : Sensor<probe.SensorData>
        {
            internal Action Sensed { get; set; }

            protected override void Sense(ref probe.SensorData data) => Sensed();
        }

        private sealed class RandomPart : Sensor<probe.SensorData>
        {
            protected override void Sense(ref probe.SensorData data) => data.Value = 3 * data.Value + Node.Random.Range(0f, 1f);
        }

        private sealed class Zones : ZoneSensor<probe.SensorData>
        {
            protected override void Write(ref probe.SensorData data, Span<Zone> zones)
            {
                foreach (var zone in zones) data.Value = 0.7f * data.Value + zone.Collider.transform.position.x + 5 * zone.Collider.transform.position.z;
            }
        }

        private sealed class Contacts : ContactSensor<probe.SensorData>
        {
            protected override void Write(ref probe.SensorData data, Span<Contact> contacts)
            {
                foreach (var contact in contacts) data.Value = 0.7f * data.Value + contact.Impulse.magnitude + contact.Point.x;
            }
        }
    }
}
