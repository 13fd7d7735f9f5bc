using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class PrimitiveTests : PhysicsFixture
    {
        static GameObject WithMesh()
        {
            var mesh = new Mesh { vertices = new[] { new Vector3(0f, 0f, 0f), new Vector3(2f, 4f, 0f), new Vector3(2f, 4f, 6f) } };
            mesh.triangles = new[] { 0, 1, 2 };
            var thing = new GameObject("with mesh");
            thing.AddComponent<MeshFilter>().sharedMesh = mesh;
            return thing;
        }

        [Test]
        public void Added_colliders_fit_the_mesh_of_their_object()
        {
            var thing = WithMesh();
            var centre = new Vector3(1f, 2f, 3f);
            var box = thing.AddComponent<BoxCollider>();
            Assert.That((box.center, box.size), Is.EqualTo((centre, new Vector3(2f, 4f, 6f))));
            var sphere = thing.AddComponent<SphereCollider>();
            Assert.That((sphere.center, sphere.radius), Is.EqualTo((centre, 3f)));
            var capsule = thing.AddComponent<CapsuleCollider>();
            Assert.That((capsule.center, capsule.radius, capsule.height), Is.EqualTo((centre, 3f, 4f)));
            Assert.That(thing.AddComponent<MeshCollider>().sharedMesh, Is.SameAs(thing.GetComponent<MeshFilter>().sharedMesh));
        }

        [Test]
        public void Colliders_of_a_copy_keep_their_size()
        {
            var thing = WithMesh();
            thing.AddComponent<BoxCollider>().size = Vector3.one;
            Assert.That(Object.Instantiate(thing).GetComponent<BoxCollider>().size, Is.EqualTo(Vector3.one));
        }

        [Test]
        public void Changes_of_the_mesh_of_one_object_do_not_change_others()
        {
            var filter = WithMesh().GetComponent<MeshFilter>();
            var other = Object.Instantiate(filter);
            var shared = other.sharedMesh;
            filter.mesh.vertices = new Vector3[3];
            filter.mesh.triangles = new[] { 2, 1, 0 };
            Assert.That(other.sharedMesh, Is.SameAs(shared));
            Assert.That((shared.vertices[1], shared.triangles[0]), Is.EqualTo((new Vector3(2f, 4f, 0f), 0)));
            Assert.That((filter.sharedMesh.vertices[1], filter.sharedMesh.triangles[0]), Is.EqualTo((Vector3.zero, 2)));
            Assert.That(new GameObject().AddComponent<MeshFilter>().mesh.vertexCount, Is.EqualTo(0));
            var copy = Object.Instantiate(shared);
            copy.Clear();
            Assert.That((copy.vertexCount, shared.vertexCount), Is.EqualTo((0, 3)));
        }

        [TestCase(PrimitiveType.Cube)]
        [TestCase(PrimitiveType.Sphere)]
        [TestCase(PrimitiveType.Capsule)]
        [TestCase(PrimitiveType.Cylinder)]
        public void Triangles_of_solid_primitives_face_outwards_and_are_closed(PrimitiveType type)
        {
            var mesh = GameObject.CreatePrimitive(type).GetComponent<MeshFilter>().sharedMesh;
            var bounds = mesh.bounds;
            mesh.RecalculateBounds();
            Assert.That((mesh.bounds.min - bounds.min).magnitude + (mesh.bounds.max - bounds.max).magnitude, Is.LessThan(1e-5f));
            Vector3[] vertices = mesh.vertices;
            int[] triangles = mesh.triangles;
            var edges = new Dictionary<(Vector3, Vector3), int>();
            for (var i = 0; i < triangles.Length; i += 3)
            {
                Vector3 a = vertices[triangles[i]], b = vertices[triangles[i + 1]], c = vertices[triangles[i + 2]];
                Assert.That(Vector3.Dot(Vector3.Cross(b - a, c - a), a + b + c), Is.GreaterThan(0f));
                foreach (var edge in new[] { (a, b), (b, c), (c, a) })
                    edges[edge] = edges.TryGetValue(edge, out var count) ? count + 1 : 1;
            }
            foreach (var edge in edges)
            {
                Assert.That(edge.Value, Is.EqualTo(1));
                Assert.That(edges.ContainsKey((edge.Key.Item2, edge.Key.Item1)), Is.True, "each edge must belong to two triangles");
            }
        }

        [TestCase(PrimitiveType.Cube, 0.5f)]
        [TestCase(PrimitiveType.Sphere, 0.5f)]
        [TestCase(PrimitiveType.Capsule, 1f)]
        [TestCase(PrimitiveType.Cylinder, 1f)]
        public void Mesh_colliders_of_primitives_have_the_shape_of_the_mesh(PrimitiveType type, float top)
        {
            var thing = GameObject.CreatePrimitive(type);
            Object.DestroyImmediate(thing.GetComponent<Collider>());
            var collider = thing.AddComponent<MeshCollider>();
            foreach (var convex in new[] { false, true })
            {
                collider.convex = convex;
                Physics.SyncTransforms();
                Assert.That(Physics.Raycast(new Vector3(0.01f, 5f, 0.02f), Vector3.down, out var hit), Is.True);
                Assert.That(hit.point.y, Is.EqualTo(top).Within(0.02f));
            }
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Rays_hit_planes_and_quads_only_from_the_front()
        {
            GameObject.CreatePrimitive(PrimitiveType.Plane);
            var quad = GameObject.CreatePrimitive(PrimitiveType.Quad);
            quad.transform.position = new Vector3(0f, 10f, 0f);
            Physics.SyncTransforms();
            Assert.That(Physics.Raycast(new Vector3(4.9f, 1f, -4.9f), Vector3.down), Is.True);
            Assert.That(Physics.Raycast(new Vector3(4.9f, -1f, -4.9f), Vector3.up), Is.False);
            Assert.That(Physics.Raycast(new Vector3(0.4f, 10.4f, -1f), Vector3.forward), Is.True);
            Assert.That(Physics.Raycast(new Vector3(0.4f, 10.4f, 1f), Vector3.back), Is.False);
        }

        [Test]
        public void A_ball_rests_on_a_plane()
        {
            GameObject.CreatePrimitive(PrimitiveType.Plane);
            var ball = Ball(new Vector3(3.3f, 1f, -2.2f));
            Run(2f);
            Assert.That((ball.position - new Vector3(3.3f, 0.5f, -2.2f)).magnitude, Is.LessThan(0.02f));
        }
    }
}
