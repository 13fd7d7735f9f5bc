using System;
using System.Collections.Generic;
using System.Diagnostics;
using NUnit.Framework;
using Unity.Collections;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Engine
{
    /// Tests the repeatability, allocations and cost of physics with many bodies.
    [Category("Slow")]
    public sealed class SwarmTests : PhysicsFixture
    {
        public class Counter : MonoBehaviour
        {
            public static int Calls;
            void FixedUpdate() => Calls++;
            void Update() => Calls++;
            void LateUpdate() => Calls++;
            void OnCollisionEnter(Collision collision) => Calls++;
            void OnTriggerEnter(Collider other) => Calls++;
        }

        static readonly Collider[] Results = new Collider[1024];

        /// Creates frictionless balls on a floor with four obstacles. In each tick, a force pulls them to the same point.
        static List<Rigidbody> Swarm(int count, bool listeners)
        {
            var frictionless = Frictionless();
            Floor(frictionless);
            for (var index = 0; index < 4; index++) Box(new Vector3(10f, 1.5f, index * 8f - 12f), new Vector3(1f, 3f, 5f), frictionless);
            var random = new System.Random(9);
            var bodies = new List<Rigidbody>();
            var side = Mathf.CeilToInt(Mathf.Sqrt(count));
            for (var index = 0; index < count; index++)
            {
                var place = new Vector3(index % side * 0.8f - 35f + (float)random.NextDouble() * 0.2f, 0.25f, index / side * 0.8f - side * 0.4f);
                var body = Ball(place, 0.25f, frictionless);
                body.maxLinearVelocity = 5f;
                if (listeners) body.gameObject.AddComponent<Counter>();
                bodies.Add(body);
            }
            return bodies;
        }

        static void Tick(List<Rigidbody> bodies)
        {
            foreach (var body in bodies)
            {
                Physics.OverlapSphereNonAlloc(body.transform.position, 3f, Results);
                body.AddForce(Vector3.ClampMagnitude(new Vector3(25f, 0.25f, 0f) - body.transform.position, 5f));
            }
            Physics.Simulate(Step);
            Physics.Simulate(Step);
            Loop.Frame(0.02f);
        }

        static ulong PositionsAfter(int ticks)
        {
            var bodies = Swarm(200, true);
            for (var tick = 0; tick < ticks; tick++) Tick(bodies);
            var hash = 14695981039346656037UL;
            foreach (var body in bodies)
            {
                var place = body.transform.position;
                foreach (var value in new[] { place.x, place.y, place.z }) hash = (hash ^ (uint)BitConverter.SingleToInt32Bits(value)) * 1099511628211UL;
            }
            return hash;
        }

        [Test]
        public void Two_runs_with_one_seed_are_bit_identical()
        {
            var first = PositionsAfter(250);
            Loop.Reset();
            Loop.Start(1);
            Physics.simulationMode = SimulationMode.Script;
            Assert.That(PositionsAfter(250), Is.EqualTo(first));
            Console.WriteLine($"positions {first:x16}"); // equal in all processes
        }

        [Test]
        public void A_physics_tick_allocates_no_managed_memory()
        {
            var bodies = Swarm(300, true);
            foreach (var body in bodies) body.transform.position += new Vector3(48f, 0f, 0f); // to the goal, because the jam is densest while it forms
            for (var tick = 0; tick < 400; tick++) Tick(bodies);
            foreach (var body in bodies) body.linearDamping = 1f;
            for (var tick = 0; tick < 100; tick++) Tick(bodies);
            var calls = Counter.Calls;
            var ticks = Allocated(() =>
            {
                for (var tick = 0; tick < 200; tick++) Tick(bodies);
            });
            var control = Allocated(() =>
            {
                for (var tick = 0; tick < 200; tick++) GC.KeepAlive(new byte[64]);
            });
            Assert.That(Counter.Calls, Is.GreaterThan(calls + 200 * 300));
            Assert.That(control, Is.GreaterThanOrEqualTo(200 * 64), "the measurement must detect the allocations of the control");
            Assert.That(ticks, Is.EqualTo(0), "bytes in 200 ticks");
        }

        static long Allocated(Action action)
        {
            GC.Collect();
            var before = GC.GetAllocatedBytesForCurrentThread();
            action();
            return GC.GetAllocatedBytesForCurrentThread() - before;
        }

        [TestCase(500)]
        [TestCase(2000, Category = "Repeats")]
        public void A_swarm_stays_on_the_floor(int count)
        {
            const int rounds = 200;
            var bodies = Swarm(count, false);
            var physics = ProcessorMillis(() =>
            {
                for (var round = 0; round < rounds; round++)
                {
                    foreach (var body in bodies) body.AddForce(Vector3.ClampMagnitude(new Vector3(5f, 0.25f, 0f) - body.transform.position, 5f));
                    Physics.Simulate(Step);
                }
            });
            var overlaps = ProcessorMillis(() =>
            {
                for (var round = 0; round < rounds; round++)
                    foreach (var body in bodies) Physics.OverlapSphereNonAlloc(body.transform.position, 3f, Results);
            });
            Console.WriteLine($"{count} bodies, processor time: {physics / rounds:0.00} ms a step, "
                + $"{overlaps / rounds:0.00} ms for {count} overlap queries of 3 m");
            foreach (var body in bodies) Assert.That(body.transform.position.y, Is.InRange(0.2f, 3f));
        }

        [Test]
        public void Positions_do_not_depend_on_the_number_of_threads()
        {
            var hashes = new List<ulong>();
            foreach (var threads in new[] { 1, 2, 4, 7 })
            {
                Loop.Reset();
                Loop.PhysicsThreads = threads;
                Loop.Start(1);
                Physics.simulationMode = SimulationMode.Script;
                hashes.Add(PositionsAfter(100));
            }
            Loop.PhysicsThreads = 1;
            Assert.That(hashes, Is.All.EqualTo(hashes[0]));
        }

        [TestCase(1)]
        [TestCase(2)]
        [TestCase(4)]
        public void Batch_results_equal_single_queries_for_any_number_of_threads(int threads)
        {
            const int places = 8;
            Loop.Reset();
            Loop.PhysicsThreads = threads;
            Loop.Start(1);
            Physics.simulationMode = SimulationMode.Script;
            var bodies = Swarm(1000, false);
            Physics.Simulate(Step);
            var parameters = new QueryParameters(Physics.AllLayers, false, QueryTriggerInteraction.Ignore);
            using (var spheres = new NativeArray<OverlapSphereCommand>(bodies.Count, Allocator.TempJob))
            using (var near = new NativeArray<ColliderHit>(bodies.Count * places, Allocator.TempJob))
            using (var rays = new NativeArray<RaycastCommand>(bodies.Count, Allocator.TempJob))
            using (var hits = new NativeArray<RaycastHit>(bodies.Count, Allocator.TempJob))
            {
                var directions = new[] { Vector3.left, Vector3.right, Vector3.forward, Vector3.back, Vector3.down };
                for (var index = 0; index < bodies.Count; index++)
                {
                    spheres.AsSpan()[index] = new OverlapSphereCommand(bodies[index].position, index % 10 * 0.2f, parameters);
                    rays.AsSpan()[index] = new RaycastCommand(bodies[index].position, directions[index % directions.Length], parameters, 5f);
                }
                spheres.AsSpan()[7] = new OverlapSphereCommand(new Vector3(float.NaN, 0f, 0f), 1f, parameters);
                rays.AsSpan()[7] = new RaycastCommand(Vector3.zero, new Vector3(float.NaN, 0f, 0f), parameters, 5f);
                for (var round = 0; round < 20; round++)
                {
                    OverlapSphereCommand.ScheduleBatch(spheres, near, 1, places).Complete();
                    RaycastCommand.ScheduleBatch(rays, hits, 1, 1).Complete();
                }
                for (var index = 0; index < bodies.Count; index++)
                {
                    var count = Math.Min(places, Physics.OverlapSphereNonAlloc(spheres[index].point, spheres[index].radius, Results));
                    for (var place = 0; place < count; place++) Assert.That(near[index * places + place].collider, Is.SameAs(Results[place]));
                    if (count < places) Assert.That(near[index * places + count].collider == null, Is.True, "the end of the results of sphere " + index);
                    Physics.Raycast(rays[index].from, rays[index].direction, out var hit, 5f);
                    Assert.That((hits[index].collider, hits[index].distance), Is.EqualTo((hit.collider, hit.distance)));
                }
            }
            Loop.PhysicsThreads = 1;
        }

        static double ProcessorMillis(Action action)
        {
            var before = Process.GetCurrentProcess().TotalProcessorTime;
            action();
            return (Process.GetCurrentProcess().TotalProcessorTime - before).TotalMilliseconds;
        }
    }
}
