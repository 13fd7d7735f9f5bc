using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests that sensors and line-of-sight rules query physics in batches, with the same results as single queries.</summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class QueryBatchTests : SimulationFixture
    {
        private readonly List<Node> nodes = new List<Node>();
        private int arrays;

        [SetUp]
        public void CountArrays() => arrays = NativeArrays.Count;

        [Test]
        public void All_nodes_share_one_batch_per_kind_of_query()
        {
            MakeSwarm(30);
            Play(1);
            var before = QueryLog.Batches;
            Manager.Step();
            Assert.That(QueryLog.Batches - before, Is.EqualTo(3), "one batch each for rays, spheres and lines of sight");
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Sensors_batches_begin_before_the_rules_are_called()
        {
            MakeSwarm(30);
            Play(1);
            var before = QueryLog.BatchesStartedEarly;
            Manager.Step();
            Assert.That(QueryLog.BatchesStartedEarly - before, Is.EqualTo(2), "one batch each for rays and spheres");
        }

        [Test]
        public void Nodes_at_one_place_see_each_other()
        {
            for (var i = 0; i < 2; i++) MakeNode(0).Node.gameObject.AddComponent<LineOfSightNeighbourhood>().Radius = 1;
            Play(3);
            Assert.That(Manager.LinkCount, Is.EqualTo(2));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Batch_results_equal_single_queries()
        {
            MakeSwarm(30);
            for (var tick = 0; tick < 5; tick++)
            {
                Play(1);
                foreach (var node in nodes) AssertEqualsSingleQueries(node);
                for (var i = 0; i < nodes.Count; i += 2) nodes[i].transform.Rotate(0, 10, 0);
            }
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Colliders_beyond_the_batch_capacity_are_found()
        {
            var sensor = MakeNode(0).Node.gameObject.AddComponent<SensorTests.Obstacles>();
            sensor.Reach = 5;
            for (var i = 0; i < 100; i++) MakeBall(new Vector3(1 + i * 0.03f, 0, 0));
            for (var tick = 0; tick < 5; tick++)
            {
                Play(1);
                Assert.That(sensor.Values.Count, Is.EqualTo(100), "tick " + tick);
            }
        }

        [Test]
        public void Walls_beyond_the_batch_capacity_are_counted()
        {
            var left = MakeNode(0).Node;
            var right = MakeNode(0).Node;
            right.transform.position = new Vector3(50, 0, 0);
            var rule = left.gameObject.AddComponent<LineOfSightNeighbourhood>();
            rule.Radius = 60;
            rule.Blocking = false;
            for (var i = 0; i < 70; i++) MakeBall(new Vector3(5 + i * 0.5f, 0, 0));
            var links = new List<LinkRecord>();
            for (var tick = 0; tick < 5; tick++)
            {
                Play(1);
                Manager.CopyLinks(links);
                Assert.That(links.ConvertAll(link => link.Attenuation), Is.EqualTo(new[] { 70f, 70f }), "tick " + tick);
            }
        }

        [Test]
        public void A_ray_fan_changed_by_another_sensor_is_cast_again()
        {
            var node = MakeNode(0).Node;
            node.gameObject.AddComponent<RayCountChanger>();
            var fan = node.gameObject.AddComponent<SensorTests.Rays>();
            for (var tick = 1; tick <= 4; tick++)
            {
                Play(1);
                Assert.That(fan.Values.Count, Is.EqualTo(tick));
            }
        }

        [Test]
        public void Batches_follow_added_and_removed_sensors()
        {
            MakeSwarm(4);
            Play(2);
            Object.DestroyImmediate(nodes[1].gameObject);
            nodes[2].GetComponent<SensorTests.Rays>().enabled = false;
            nodes[3].Sleep(0.12);
            nodes.RemoveAt(1);
            var added = MakeNodeWithSensors(new Vector3(2, 0, 2));
            Play(1);
            AssertEqualsSingleQueries(nodes[0]);
            AssertEqualsSingleQueries(added);
            nodes[1].GetComponent<SensorTests.Rays>().enabled = true;
            Play(4);
            foreach (var node in nodes) AssertEqualsSingleQueries(node);
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void The_next_simulation_batches_the_same_sensors()
        {
            MakeSwarm(4);
            Play(3);
            Manager.enabled = false;
            Manager.enabled = true;
            Play(3);
            foreach (var node in nodes) AssertEqualsSingleQueries(node);
            var before = QueryLog.Batches;
            Manager.Step();
            Assert.That(QueryLog.Batches - before, Is.EqualTo(3));
        }

        [Test]
        public void Native_memory_is_freed_with_the_simulation()
        {
            MakeSwarm(4);
            Play(3);
            Assert.That(NativeArrays.Count, Is.GreaterThan(arrays));
            Manager.enabled = false;
            Assert.That(NativeArrays.Count, Is.EqualTo(arrays));
        }

        [Test]
        public void Queries_complete_before_custom_rules_run()
        {
            MakeSwarm(4);
            var rule = nodes[2].gameObject.AddComponent<ColliderMovingRule>();
            Play(2);
            rule.Ball = new GameObject("Ball") { transform = { position = nodes[1].transform.position } }.AddComponent<SphereCollider>();
            Play(1);
            Assert.That(rule.Calls, Is.EqualTo(3));
            Assert.That(rule.SawQueries, Is.False);
            var seen = nodes[1].GetComponent<SensorTests.Obstacles>().Values;
            Assert.That(seen.Exists(obstacle => ReferenceEquals(obstacle.Collider, rule.Ball)), Is.True, "the position before the rules ran counts");
            Assert.That(Errors, Is.Empty);
        }

        private sealed class ColliderMovingRule : NeighbourhoodRule
        {
            internal Collider Ball { get; set; }

            internal int Calls { get; private set; }

            internal bool SawQueries { get; private set; }

            protected override void FindNeighbours(NeighbourCollector neighbours)
            {
                Calls++;
                SawQueries |= QueryLog.IsRunning;
                if (Ball == null) return;
                Ball.transform.position += new Vector3(0, 50, 0);
                Physics.SyncTransforms();
            }
        }

        private void MakeSwarm(int count)
        {
            nodes.Clear();
            var random = new RandomStream(3, 0, RandomPurpose.Scene);
            for (var i = 0; i < count; i++) nodes.Add(MakeNodeWithSensors(new Vector3(random.Range(0f, 8f), 0, random.Range(0f, 8f))));
            for (var i = 0; i < count; i++) MakeBall(new Vector3(random.Range(0f, 8f), 0, random.Range(0f, 8f)));
        }

        private Node MakeNodeWithSensors(Vector3 place)
        {
            var node = MakeNode(0).Node;
            node.transform.position = place;
            node.gameObject.AddComponent<SphereCollider>().radius = 0.3f;
            // The node's own rays must ignore the collider of this child.
            var wing = new GameObject("Wing");
            wing.transform.SetParent(node.transform, false);
            wing.transform.localPosition = new Vector3(1, 0, 0);
            wing.AddComponent<BoxCollider>().size = new Vector3(0.1f, 1, 1);
            node.gameObject.AddComponent<SensorTests.Rays>().Range = 3;
            node.gameObject.AddComponent<SensorTests.Obstacles>().Reach = 1.5f;
            var sight = node.gameObject.AddComponent<LineOfSightNeighbourhood>();
            sight.Radius = 3;
            sight.Blocking = false;
            return node;
        }

        private static void MakeBall(Vector3 place)
        {
            var ball = new GameObject("Ball");
            ball.transform.position = place;
            ball.AddComponent<SphereCollider>().radius = 0.1f;
        }

        /// <summary>Compares a node's sensor data with the results of single queries. No object may have moved since the node's round.</summary>
        private static void AssertEqualsSingleQueries(Node node)
        {
            var rays = node.GetComponent<SensorTests.Rays>();
            if (rays.enabled)
            {
                foreach (var ray in rays.Values)
                {
                    var nearest = 3f;
                    foreach (var hit in All(node.Position, ray.Direction, 3))
                    {
                        if (!hit.collider.transform.IsChildOf(node.transform)) nearest = Mathf.Min(nearest, hit.distance);
                    }
                    Assert.That(ray.Distance, Is.EqualTo(nearest).Within(1e-4f));
                }
            }
            var near = new HashSet<Collider>(Physics.OverlapSphere(node.Position, 1.5f, Physics.DefaultRaycastLayers, QueryTriggerInteraction.Ignore));
            near.RemoveWhere(collider => collider.transform.IsChildOf(node.transform));
            Assert.That(node.GetComponent<SensorTests.Obstacles>().Values.ConvertAll(obstacle => obstacle.Collider), Is.EquivalentTo(near));
        }

        private static List<RaycastHit> All(Vector3 origin, Vector3 direction, float distance)
        {
            var hits = new RaycastHit[64];
            var count = Physics.RaycastNonAlloc(origin, direction, hits, distance, Physics.DefaultRaycastLayers, QueryTriggerInteraction.Ignore);
            return new List<RaycastHit>(hits).GetRange(0, count);
        }

        public sealed class RayCountChanger : Sensor<probe.SensorData>
        {
            protected override void Sense(ref probe.SensorData data) => GetComponent<SensorTests.Rays>().Rays = (int)SimulationManager.Current.Tick + 1;
        }
    }
}
