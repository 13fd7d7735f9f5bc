using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    public sealed class MeshColliderTests : PhysicsFixture
    {
        /// Returns a ramp that is 10 m wide and rises by 1 m per metre along x.
        static Mesh Ramp()
        {
            var mesh = new Mesh { name = "ramp" };
            mesh.vertices = new[] { new Vector3(-10f, -10f, -5f), new Vector3(10f, 10f, -5f), new Vector3(-10f, -10f, 5f), new Vector3(10f, 10f, 5f) };
            mesh.triangles = new[] { 0, 2, 1, 1, 2, 3 };
            return mesh;
        }

        static Mesh Pyramid()
        {
            var mesh = new Mesh { name = "pyramid" };
            mesh.vertices = new[]
            {
                new Vector3(-1f, 0f, -1f), new Vector3(1f, 0f, -1f), new Vector3(1f, 0f, 1f), new Vector3(-1f, 0f, 1f), new Vector3(0f, 2f, 0f),
            };
            mesh.triangles = new[] { 0, 1, 2, 0, 2, 3, 0, 4, 1, 1, 4, 2, 2, 4, 3, 3, 4, 0 };
            return mesh;
        }

        static MeshCollider AddMeshCollider(Mesh mesh, bool convex)
        {
            var collider = new GameObject(mesh.name).AddComponent<MeshCollider>();
            collider.convex = convex;
            collider.sharedMesh = mesh;
            return collider;
        }

        [Test]
        public void Rays_hit_only_the_front_of_mesh_triangles()
        {
            AddMeshCollider(Ramp(), false);
            Physics.SyncTransforms();
            Assert.That(Physics.Raycast(new Vector3(3f, 20f, 0f), Vector3.down, out var hit), Is.True);
            Assert.That(hit.point.y, Is.EqualTo(3f).Within(1e-3f));
            Assert.That((hit.normal - new Vector3(-1f, 1f, 0f).normalized).magnitude, Is.LessThan(1e-3f));
            Assert.That(hit.triangleIndex, Is.InRange(0, 1));
            Assert.That(Physics.Raycast(new Vector3(3f, -20f, 0f), Vector3.up), Is.False, "queriesHitBackfaces is off");
        }

        [Test]
        public void A_hit_has_the_index_of_the_triangle_in_the_mesh()
        {
            var plane = GameObject.CreatePrimitive(PrimitiveType.Plane).GetComponent<MeshCollider>();
            Vector3[] vertices = plane.sharedMesh.vertices;
            int[] triangles = plane.sharedMesh.triangles;
            for (var index = 0; index < triangles.Length; index += 3)
            {
                var centre = (vertices[triangles[index]] + vertices[triangles[index + 1]] + vertices[triangles[index + 2]]) / 3f;
                Assert.That(Physics.Raycast(centre + Vector3.up, Vector3.down, out var hit), Is.True);
                Assert.That(hit.triangleIndex, Is.EqualTo(index / 3));
                Assert.That(Physics.SphereCast(centre + Vector3.up, 0.01f, Vector3.down, out hit), Is.True);
                Assert.That(hit.triangleIndex, Is.EqualTo(index / 3));
            }
        }

        [Test]
        public void Normals_of_a_mesh_are_copies()
        {
            var normals = new[] { Vector3.up };
            var mesh = new Mesh { vertices = new Vector3[1], normals = normals };
            normals[0] = Vector3.down;
            mesh.normals[0] = Vector3.left;
            Assert.That(mesh.normals[0], Is.EqualTo(Vector3.up));
        }

        [Test]
        public void A_ball_rolls_down_a_mesh()
        {
            AddMeshCollider(Ramp(), false);
            var ball = Ball(new Vector3(5f, 5.8f, 0f));
            Run(1f);
            Assert.That(ball.position.x, Is.LessThan(3.5f));
            Assert.That(ball.position.y - ball.position.x, Is.EqualTo(0.5f * Mathf.Sqrt(2f)).Within(0.1f), "the ball must be on the ramp");
        }

        [Test]
        public void A_closest_point_before_a_sync_keeps_the_shape()
        {
            var pyramid = AddMeshCollider(Pyramid(), true);
            Physics.SyncTransforms();
            pyramid.transform.localScale = 2f * Vector3.one;
            var point = Physics.ClosestPoint(new Vector3(0f, 9f, 0f), pyramid, Vector3.zero, Quaternion.identity);
            Assert.That(point.y, Is.EqualTo(2f).Within(1e-3f));
            Assert.That(Physics.Raycast(new Vector3(0f, 9f, 0f), Vector3.down), Is.True);
        }

        [TestCase(2f, 2f, 2f)]
        [TestCase(-1f, 1f, 1f)]
        [TestCase(1f, 3f, -2f)]
        public void A_scaled_or_mirrored_mesh_keeps_its_front(float x, float y, float z)
        {
            AddMeshCollider(Ramp(), false).transform.localScale = new Vector3(x, y, z);
            Physics.SyncTransforms();
            Assert.That(Physics.Raycast(new Vector3(2f, 90f, 0f), Vector3.down, out var hit), Is.True);
            Assert.That(hit.point.y, Is.EqualTo(2f * y / x).Within(1e-2f));
        }

        [TestCase(1f)]
        [TestCase(-1f)]
        public void A_convex_body_stands_on_its_base(float mirror)
        {
            Floor();
            var pyramid = AddMeshCollider(Pyramid(), true);
            pyramid.transform.localScale = new Vector3(mirror, 1f, 1f);
            pyramid.transform.position = new Vector3(0f, 0.5f, 0f);
            var body = pyramid.gameObject.AddComponent<Rigidbody>();
            Assert.That(body.worldCenterOfMass.y, Is.EqualTo(1f).Within(0.02f), "the centre of mass must be at a quarter of the height");
            Run(2f);
            Assert.That(body.position.y, Is.EqualTo(0f).Within(0.02f));
            Assert.That(Quaternion.Angle(body.rotation, Quaternion.identity), Is.LessThan(1f));
        }

        [Test]
        public void A_concave_mesh_is_rejected_for_a_non_kinematic_body()
        {
            var collider = AddMeshCollider(Ramp(), false);
            var body = collider.gameObject.AddComponent<Rigidbody>();
            Assert.That(Errors.Count, Is.EqualTo(1));
            Assert.That(Errors[0], Is.StringContaining("Non-convex MeshCollider with non-kinematic Rigidbody"));
            Run(0.1f);
            Assert.That(Physics.Raycast(new Vector3(3f, 20f, 0f), Vector3.down), Is.False);
            body.isKinematic = true;
            Assert.That(Physics.Raycast(new Vector3(3f, 20f, 0f), Vector3.down), Is.True);
            body.isKinematic = false;
            Assert.That(Physics.Raycast(new Vector3(3f, 20f, 0f), Vector3.down), Is.False);
            Run(0.1f);
        }

        [Test]
        public void A_concave_trigger_is_rejected()
        {
            var collider = AddMeshCollider(Ramp(), false);
            collider.isTrigger = true;
            collider.transform.position = new Vector3(0f, 0.1f, 0f);
            Physics.SyncTransforms();
            Assert.That(Errors.Count, Is.EqualTo(1), "it must not be logged each time that the object moves");
            Assert.That(Errors[0], Is.StringContaining("Triggers on concave MeshColliders are not supported"));
            Assert.That(Physics.CheckSphere(Vector3.zero, 1f), Is.False);
            collider.convex = true;
            Assert.That(Physics.CheckSphere(Vector3.zero, 1f), Is.True);
        }

        [Test]
        public void A_mesh_of_lines_is_rejected()
        {
            var lines = Ramp();
            lines.SetIndices(new[] { 0, 1, 2, 3, 1, 2 }, MeshTopology.Lines, 0);
            AddMeshCollider(lines, false);
            Assert.That(Errors[0], Is.StringContaining("has lines, points or quads"));
        }

        [Test]
        public void A_mesh_without_a_convex_hull_is_reported_by_name()
        {
            AddMeshCollider(Ramp(), true);
            Assert.That(Errors.Count, Is.LessThanOrEqualTo(1)); // PhysX can build a thin hull of a flat mesh, so an error is optional
            var point = new Mesh { name = "point" };
            point.vertices = new[] { Vector3.zero };
            point.triangles = new[] { 0, 0, 0 };
            Errors.Clear();
            var collider = AddMeshCollider(point, true);
            Assert.That(Errors.Count, Is.EqualTo(1));
            Assert.That(Errors[0], Is.StringContaining("point"));
            collider.transform.position = Vector3.right;
            Physics.Simulate(Step);
            Assert.That(Errors.Count, Is.EqualTo(1), "the mesh must not be cooked again after each move");
        }

        [Test]
        public void ClosestPoint_supports_only_convex_meshes()
        {
            var pyramid = AddMeshCollider(Pyramid(), true);
            Assert.That((pyramid.ClosestPoint(new Vector3(0f, -5f, 0f)) - Vector3.zero).magnitude, Is.LessThan(1e-3f));
            var ramp = AddMeshCollider(Ramp(), false);
            Assert.That(ramp.ClosestPoint(new Vector3(0f, -5f, 0f)), Is.EqualTo(new Vector3(0f, -5f, 0f)));
            Assert.That(Errors.Count, Is.EqualTo(1));
        }
    }
}
