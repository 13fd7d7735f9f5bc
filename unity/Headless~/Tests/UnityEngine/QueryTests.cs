using System;
using System.Collections.Generic;
using NUnit.Framework;
using Unity.Collections;
using Unity.Jobs;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Engine
{
    [TestFixture, Category("AnyPlacement")]
    public sealed class QueryTests : PhysicsFixture
    {
        static readonly Collider[] Results = new Collider[4096];

        [TestCase(500, 60f, 3f)]
        [TestCase(2000, 20f, 3f)]
        [TestCase(300, 15f, 20f)]
        public void Sphere_overlaps_match_brute_force(int count, float half, float radius)
        {
            var random = new System.Random(count);
            Floor();
            var colliders = new List<SphereCollider>();
            for (var index = 0; index < count; index++)
            {
                var place = new Vector3(Number(half), Number(3f), Number(half));
                var collider = new GameObject().AddComponent<SphereCollider>();
                collider.transform.position = place;
                collider.radius = 0.1f + (float)random.NextDouble() * (index % 50 == 0 ? 10f : 0.5f);
                colliders.Add(collider);
            }
            Physics.SyncTransforms();
            for (var trial = 0; trial < 100; trial++)
            {
                var center = new Vector3(Number(half), Number(3f), Number(half));
                var expected = new HashSet<Collider>();
                foreach (var collider in colliders)
                    if (Vector3.Distance(collider.transform.position, center) <= radius + collider.radius) expected.Add(collider);
                var found = new HashSet<Collider>();
                var number = Physics.OverlapSphereNonAlloc(center, radius, Results);
                for (var index = 0; index < number; index++)
                    if (Results[index] is SphereCollider) found.Add(Results[index]);
                Assert.That(found.SetEquals(expected), $"{found.Count} instead of {expected.Count} around {center}");
            }

            float Number(float most) => (float)(random.NextDouble() * 2 - 1) * most;
        }

        [TestCase(false)]
        [TestCase(true)]
        public void Queries_find_colliders_that_move_between_steps(bool replaces)
        {
            var random = new System.Random(3);
            var colliders = new List<SphereCollider>();
            for (var index = 0; index < 60; index++) colliders.Add(Make());
            for (var step = 0; step < 300; step++)
            {
                foreach (var collider in colliders)
                    if (random.Next(3) == 0) collider.transform.position = Place();
                if (random.Next(2) == 0) Physics.Simulate(0.02f);
                for (var index = 0; replaces && index < colliders.Count; index++)
                {
                    if (random.Next(30) > 0) continue;
                    UnityEngine.Object.DestroyImmediate(colliders[index].gameObject);
                    colliders[index] = Make();
                }
                Physics.SyncTransforms();
                foreach (var collider in colliders)
                {
                    var center = Place();
                    var offset = collider.transform.position - center;
                    var count = Physics.OverlapSphereNonAlloc(center, offset.magnitude, Results);
                    Assert.That(Array.IndexOf(Results, collider, 0, count), Is.GreaterThanOrEqualTo(0), $"overlap in step {step}");
                    // A ray ignores colliders that contain its origin.
                    Assert.That(offset.magnitude <= collider.radius || Physics.Raycast(center, offset, offset.magnitude), $"ray in step {step}");
                }
                Physics.Simulate(0.02f);
            }

            SphereCollider Make()
            {
                var sphere = new GameObject().AddComponent<SphereCollider>();
                sphere.transform.position = Place();
                return sphere;
            }

            Vector3 Place() => new Vector3((float)random.NextDouble(), (float)random.NextDouble(), (float)random.NextDouble()) * 20f;
        }

        [Test]
        public void Queries_find_colliders_after_others_were_destroyed()
        {
            Floor(); // so that a collider is always left
            var place = new Vector3(0f, 50f, 0f);
            for (var steps = 0; steps < 30; steps++)
            {
                var colliders = Row(10);
                Assert.That(Physics.CheckSphere(colliders[0].transform.position, 0.1f));
                colliders[1].transform.position += Vector3.up;
                Run(steps * Step);
                colliders[9].transform.position = place;
                Run(Step);
                UnityEngine.Object.DestroyImmediate(colliders[0].gameObject);
                Assert.That(Physics.CheckSphere(place, 0.1f), $"after {steps} steps");
                for (var index = 1; index < colliders.Count; index++) UnityEngine.Object.DestroyImmediate(colliders[index].gameObject);
            }
        }

        [Test]
        public void Queries_find_colliders_that_replaced_all_others()
        {
            for (var steps = 0; steps < 30; steps++)
            {
                var colliders = Row(10);
                Assert.That(Physics.CheckSphere(colliders[0].transform.position, 0.1f));
                colliders[1].transform.position += Vector3.up;
                Run(Step);
                foreach (var collider in colliders) UnityEngine.Object.DestroyImmediate(collider.gameObject);
                colliders = Row(10);
                Run(steps * Step);
                colliders.AddRange(Row(10, height: 20f));
                for (var step = 0; step < 30; step++)
                {
                    foreach (var collider in colliders) Assert.That(Physics.CheckSphere(collider.transform.position, 0.1f), $"{steps} and {step} steps");
                    Run(Step);
                }
                foreach (var collider in colliders) UnityEngine.Object.DestroyImmediate(collider.gameObject);
            }
        }

        [Test]
        public void A_new_collider_keeps_its_place_when_a_moved_one_is_destroyed()
        {
            var old = new GameObject().AddComponent<SphereCollider>();
            old.transform.position = new Vector3(10f, 0f, 0f);
            Physics.SyncTransforms();
            UnityEngine.Object.DestroyImmediate(old.gameObject);
            var added = new GameObject().AddComponent<SphereCollider>();
            Assert.That(Physics.CheckSphere(Vector3.zero, 0.1f));
            Assert.That(added.bounds.center, Is.EqualTo(Vector3.zero));
        }

        static List<SphereCollider> Row(int count, float height = 5f)
        {
            var colliders = new List<SphereCollider>();
            for (var index = 0; index < count; index++)
            {
                colliders.Add(new GameObject().AddComponent<SphereCollider>());
                colliders[index].transform.position = new Vector3(3f * index, height, 0f);
            }
            Physics.SyncTransforms();
            return colliders;
        }

        [Test]
        public void Overlaps_follow_moving_bodies()
        {
            var bodies = new List<Rigidbody>();
            for (var index = 0; index < 50; index++)
            {
                var body = Ball(new Vector3(index * 3f - 75f, 0f, 0f));
                body.useGravity = false;
                body.linearVelocity = new Vector3(0f, 0f, index);
                bodies.Add(body);
            }
            Run(1f);
            foreach (var body in bodies)
            {
                Assert.That(Physics.OverlapSphereNonAlloc(body.transform.position, 0.1f, Results), Is.EqualTo(1));
                Assert.That(Results[0].attachedRigidbody, Is.SameAs(body));
            }
        }

        [Test]
        public void A_buffer_that_is_too_small_is_filled()
        {
            for (var index = 0; index < 10; index++) Box(Vector3.zero, Vector3.one);
            Assert.That(Physics.OverlapSphereNonAlloc(Vector3.zero, 1f, new Collider[4]), Is.EqualTo(4));
            Assert.That(Physics.OverlapSphere(Vector3.zero, 1f).Length, Is.EqualTo(10));
        }

        [Test]
        public void Layers_and_triggers_are_filtered()
        {
            var box = Box(Vector3.zero, Vector3.one);
            box.gameObject.layer = 5;
            Assert.That(Physics.CheckSphere(Vector3.zero, 1f, 1 << 5), Is.True);
            Assert.That(Physics.CheckSphere(Vector3.zero, 1f, ~(1 << 5)), Is.False);
            box.isTrigger = true;
            Assert.That(Physics.CheckSphere(Vector3.zero, 1f, ~0, QueryTriggerInteraction.Ignore), Is.False);
            Assert.That(Physics.CheckSphere(Vector3.zero, 1f, ~0, QueryTriggerInteraction.Collide), Is.True);
            Physics.queriesHitTriggers = false;
            Assert.That(Physics.CheckSphere(Vector3.zero, 1f), Is.False);
        }

        [TestCase(typeof(BoxCollider))]
        [TestCase(typeof(SphereCollider))]
        [TestCase(typeof(CapsuleCollider))]
        public void The_centre_of_a_collider_is_a_point_of_its_transform(System.Type type)
        {
            var parent = new GameObject("parent").transform;
            var child = new GameObject("child").transform;
            child.SetParent(parent, false);
            child.localRotation = Quaternion.Euler(0f, 45f, 0f);
            var collider = (Collider)child.gameObject.AddComponent(type);
            parent.position = new Vector3(5f, 0f, 0f);
            parent.localScale = new Vector3(4f, 1f, 1f);
            var centre = new Vector3(2f, 0f, 0f);
            if (collider is BoxCollider box) box.center = centre;
            else if (collider is SphereCollider sphere) sphere.center = centre;
            else ((CapsuleCollider)collider).center = centre;
            Physics.SyncTransforms();
            Assert.That((collider.bounds.center - child.TransformPoint(centre)).magnitude, Is.LessThan(1e-4f));
            var body = parent.gameObject.AddComponent<Rigidbody>();
            body.isKinematic = true;
            Assert.That((collider.bounds.center - child.TransformPoint(centre)).magnitude, Is.LessThan(1e-4f));
        }

        [Test]
        public void Closest_points_match_known_values()
        {
            var box = Box(new Vector3(0f, 0f, 0f), new Vector3(2f, 2f, 2f));
            Assert.That(box.ClosestPoint(new Vector3(5f, 0.5f, 0f)) == new Vector3(1f, 0.5f, 0f), Is.True);
            Assert.That(box.ClosestPoint(new Vector3(0.2f, 0.3f, 0f)) == new Vector3(0.2f, 0.3f, 0f), Is.True);
            box.transform.rotation = Quaternion.Euler(0f, 45f, 0f);
            Physics.SyncTransforms();
            Assert.That(box.ClosestPoint(new Vector3(5f, 0f, 0f)) == new Vector3(Mathf.Sqrt(2f), 0f, 0f), Is.True);
            var capsule = new GameObject().AddComponent<CapsuleCollider>();
            capsule.height = 4f;
            Assert.That(capsule.ClosestPoint(new Vector3(0f, 9f, 0f)) == new Vector3(0f, 2f, 0f), Is.True);
            Assert.That(capsule.ClosestPoint(new Vector3(3f, 1f, 0f)) == new Vector3(0.5f, 1f, 0f), Is.True);
            capsule.direction = 0;
            Assert.That(capsule.ClosestPoint(new Vector3(9f, 0f, 0f)) == new Vector3(2f, 0f, 0f), Is.True);
            Assert.That(Physics.ClosestPoint(new Vector3(9f, 0f, 0f), capsule, new Vector3(1f, 0f, 0f), Quaternion.identity) == new Vector3(3f, 0f, 0f),
                Is.True);
        }

        [Test]
        public void A_direction_can_be_as_short_as_the_velocity_of_a_body_at_rest()
        {
            Box(new Vector3(5f, 0f, 0f), Vector3.one);
            Assert.That(Physics.Raycast(Vector3.zero, new Vector3(1e-6f, 0f, 0f), out var hit), Is.True);
            Assert.That(hit.distance, Is.EqualTo(4.5f).Within(1e-4f));
            Assert.That(Physics.RaycastAll(Vector3.zero, new Vector3(1e-6f, 0f, 0f)).Length, Is.EqualTo(1));
            Assert.That(Physics.Raycast(Vector3.zero, Vector3.zero), Is.False);
        }

        [Test]
        public void Raycasts_match_known_values()
        {
            var box = Box(new Vector3(10f, 0f, 0f), new Vector3(2f, 2f, 2f));
            var ball = Ball(new Vector3(0f, 0f, 10f), 1f);
            var capsule = new GameObject().AddComponent<CapsuleCollider>();
            capsule.transform.position = new Vector3(-10f, 0f, 0f);
            capsule.height = 4f;
            Physics.SyncTransforms();

            Assert.That(Physics.Raycast(Vector3.zero, new Vector3(7f, 0f, 0f), out var hit), Is.True);
            Assert.That(hit.collider, Is.SameAs(box));
            Assert.That(hit.distance, Is.EqualTo(9f).Within(1e-5f));
            Assert.That(hit.point == new Vector3(9f, 0f, 0f) && hit.normal == Vector3.left, Is.True);

            Assert.That(Physics.Raycast(new Ray(new Vector3(0f, 0.6f, 0f), Vector3.forward), out hit), Is.True);
            Assert.That(hit.rigidbody, Is.SameAs(ball));
            Assert.That(hit.distance, Is.EqualTo(9.2f).Within(1e-4f));
            Assert.That(hit.normal == new Vector3(0f, 0.6f, -0.8f), Is.True);

            Assert.That(Physics.Raycast(new Vector3(0f, 1f, 0f), Vector3.left, out hit), Is.True);
            Assert.That(hit.distance, Is.EqualTo(9.5f).Within(1e-4f));
            Assert.That(Physics.Raycast(new Vector3(-10f, 9f, 0f), Vector3.down, out hit), Is.True);
            Assert.That(hit.distance, Is.EqualTo(7f).Within(1e-4f));

            Assert.That(Physics.Raycast(Vector3.zero, Vector3.right, 8.9f), Is.False);
            Assert.That(Physics.Raycast(Vector3.zero, Vector3.up), Is.False);
            Assert.That(Physics.Raycast(new Vector3(10f, 0f, 0f), Vector3.right), Is.False, "a ray that starts inside a collider must not hit it");
            Assert.That(Physics.Linecast(Vector3.zero, new Vector3(9.5f, 0f, 0f), out hit) && hit.collider == box, Is.True);
            box.gameObject.layer = 2;
            Assert.That(Physics.Raycast(Vector3.zero, Vector3.right), Is.False, "a ray must not hit the layer Ignore Raycast");
        }

        [Test]
        public void A_raycast_hits_the_nearest_of_random_spheres()
        {
            var random = new System.Random(3);
            var balls = new List<SphereCollider>();
            for (var index = 0; index < 400; index++)
            {
                var ball = new GameObject().AddComponent<SphereCollider>();
                ball.transform.position = new Vector3(Number(), Number() * 0.1f, Number());
                balls.Add(ball);
            }
            Physics.SyncTransforms();
            var hits = 0;
            for (var trial = 0; trial < 300; trial++)
            {
                var origin = new Vector3(Number(), Number(), Number()) * 1.5f;
                var direction = (balls[trial].transform.position - origin + new Vector3(Number(), 0f, Number()) * 0.02f).normalized;
                var expected = float.PositiveInfinity;
                foreach (var ball in balls)
                    if (ball.Raycast(new Ray(origin, direction), out var one, 1000f)) expected = Mathf.Min(expected, one.distance);
                var found = Physics.Raycast(origin, direction, out var hit);
                Assert.That(found, Is.EqualTo(!float.IsInfinity(expected)));
                if (!found) continue;
                hits++;
                Assert.That(hit.distance, Is.EqualTo(expected).Within(1e-3f));
            }
            Assert.That(hits, Is.GreaterThan(100));

            float Number() => (float)(random.NextDouble() * 2 - 1) * 40f;
        }

        [Test]
        public void RaycastNonAlloc_returns_all_hits()
        {
            for (var index = 1; index <= 5; index++) Box(new Vector3(index * 2f, 0f, 0f), Vector3.one);
            var hits = new RaycastHit[16];
            Assert.That(Physics.RaycastNonAlloc(Vector3.zero, Vector3.right, hits), Is.EqualTo(5));
            Assert.That(Physics.RaycastNonAlloc(Vector3.zero, Vector3.right, hits, 5f), Is.EqualTo(2));
        }

        [TestCase(1)]
        [TestCase(3)]
        public void A_batch_of_overlaps_completes_on_demand(int threads)
        {
            Loop.PhysicsThreads = threads;
            Loop.Reset();
            var all = new List<Collider>();
            for (var index = 0; index < 500; index++)
            {
                var ball = GameObject.CreatePrimitive(PrimitiveType.Sphere);
                ball.transform.position = new Vector3(2 * index, 0, 0);
                all.Add(ball.GetComponent<Collider>());
            }
            Physics.SyncTransforms();
            var commands = new NativeArray<OverlapSphereCommand>(500, Allocator.Persistent);
            var hits = new NativeArray<ColliderHit>(1000, Allocator.Persistent);
            for (var index = 0; index < 500; index++)
                commands[index] = new OverlapSphereCommand(new Vector3(2 * index, 0, 0), 0.1f, QueryParameters.Default);
            for (var way = 0; way < 2; way++)
            {
                var handle = OverlapSphereCommand.ScheduleBatch(commands, hits, 1, 2);
                Assert.That(QueryLog.IsRunning, Is.False, "the batch must be scheduled but not started");
                JobHandle.ScheduleBatchedJobs();
                Assert.That(QueryLog.IsRunning, Is.True);
                Assert.That(handle.IsCompleted, Is.False);
                if (way == 0) handle.Complete();
                else Physics.CheckSphere(Vector3.zero, 1);
                Assert.That(handle.IsCompleted, Is.True);
                for (var index = 0; index < 500; index++)
                {
                    Assert.That(hits[2 * index].collider, Is.SameAs(all[index]));
                    Assert.That(hits[2 * index + 1].collider, Is.Null);
                }
            }
            commands.Dispose();
            hits.Dispose();
            Loop.PhysicsThreads = 1;
        }

        [Test]
        public void Arrays_of_a_batch_cannot_be_disposed_before_it_ends()
        {
            Box(new Vector3(5f, 0f, 0f), Vector3.one);
            var rays = new NativeArray<RaycastCommand>(1, Allocator.TempJob);
            var rayHits = new NativeArray<RaycastHit>(1, Allocator.TempJob);
            var spheres = new NativeArray<OverlapSphereCommand>(1, Allocator.TempJob);
            var sphereHits = new NativeArray<ColliderHit>(2, Allocator.TempJob);
            rays[0] = new RaycastCommand(Vector3.zero, Vector3.right, QueryParameters.Default);
            spheres[0] = new OverlapSphereCommand(Vector3.zero, 5f, QueryParameters.Default);
            var rayBatch = RaycastCommand.ScheduleBatch(rays, rayHits, 1, 1);
            var sphereBatch = OverlapSphereCommand.ScheduleBatch(spheres, sphereHits, 1, 2);
            Assert.Throws<InvalidOperationException>(() => rays.Dispose());
            Assert.Throws<InvalidOperationException>(() => rayHits.Dispose());
            Assert.Throws<InvalidOperationException>(() => spheres.Dispose());
            JobHandle.ScheduleBatchedJobs();
            Assert.Throws<InvalidOperationException>(() => sphereHits.Dispose());
            rayBatch.Complete();
            sphereBatch.Complete();
            Assert.That((rayHits[0].distance, sphereHits[0].collider != null), Is.EqualTo((4.5f, true)));
            var disposed = rayHits;
            rayHits.Dispose();
            sphereHits.Dispose();
            Assert.Throws<ObjectDisposedException>(() => RaycastCommand.ScheduleBatch(rays, disposed, 1, 1));
            Assert.Throws<ObjectDisposedException>(() => OverlapSphereCommand.ScheduleBatch(spheres, sphereHits, 1, 0));
            rays.Dispose();
            spheres.Dispose();
        }

        [Test]
        public void A_ray_of_a_batch_can_hit_back_faces_and_all_faces_of_a_mesh()
        {
            var mesh = GameObject.CreatePrimitive(PrimitiveType.Cube);
            UnityEngine.Object.DestroyImmediate(mesh.GetComponent<Collider>());
            mesh.AddComponent<MeshCollider>();
            Assert.That(DistancesOf(1, false, false), Is.EqualTo(new[] { 1.5f }), "near side");
            Assert.That(DistancesOf(4, false, false), Is.EqualTo(new[] { 1.5f }));
            Assert.That(DistancesOf(4, true, false), Is.EqualTo(new[] { 1.5f }), "the far side is a back face");
            Assert.That(DistancesOf(4, true, true), Is.EqualTo(new[] { 1.5f, 2.5f }));
            mesh.transform.position = Vector3.left * 2f;
            Physics.SyncTransforms();
            Assert.That(DistancesOf(1, false, false), Is.Empty, "from the inside");
            Assert.That(DistancesOf(1, false, true), Is.EqualTo(new[] { 0.5f }));

            float[] DistancesOf(int maxHits, bool allFaces, bool backFaces)
            {
                using (var commands = new NativeArray<RaycastCommand>(1, Allocator.TempJob))
                using (var hits = new NativeArray<RaycastHit>(maxHits, Allocator.TempJob))
                {
                    var query = new QueryParameters(Physics.AllLayers, allFaces, QueryTriggerInteraction.Ignore, backFaces);
                    commands.AsSpan()[0] = new RaycastCommand(new Vector3(-2f, 0.1f, 0.2f), Vector3.right, query);
                    RaycastCommand.ScheduleBatch(commands, hits, 1, maxHits).Complete();
                    var found = Array.FindAll(hits.AsSpan().ToArray(), hit => hit.collider);
                    var distances = Array.ConvertAll(found, hit => Mathf.Round(hit.distance * 1e4f) / 1e4f);
                    Array.Sort(distances);
                    return distances;
                }
            }
        }

        [Test]
        public void A_direction_of_a_batch_has_length_1()
        {
            using (var commands = new NativeArray<RaycastCommand>(1, Allocator.TempJob))
            using (var hits = new NativeArray<RaycastHit>(1, Allocator.TempJob))
            {
                foreach (var direction in new[] { Vector3.zero, new Vector3(0, 0, 2), new Vector3(0.9f, 0, 0) })
                {
                    commands.AsSpan()[0] = new RaycastCommand(Vector3.zero, direction, QueryParameters.Default);
                    Assert.Throws<ArgumentException>(() => RaycastCommand.ScheduleBatch(commands, hits, 1, 1));
                }
            }
        }
    }
}
