using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Engine
{
    [TestFixture, Category("AnyPlacement")]
    public sealed class TerrainColliderTests : PhysicsFixture
    {
        /// Returns a terrain of 64 m by 64 m whose height is half of x.
        static TerrainData Slope()
        {
            var data = new TerrainData { heightmapResolution = 65, size = new Vector3(64f, 100f, 64f) };
            var heights = new float[65, 65];
            for (var z = 0; z < 65; z++)
                for (var x = 0; x < 65; x++) heights[z, x] = x / 200f;
            data.SetHeights(0, 0, heights);
            return data;
        }

        static TerrainCollider Terrain(TerrainData data, Vector3 place)
        {
            var collider = new GameObject("Terrain").AddComponent<TerrainCollider>();
            collider.transform.position = place;
            collider.terrainData = data;
            return collider;
        }

        static float HeightAt(float x, float z)
        {
            Physics.SyncTransforms();
            Assert.That(Physics.Raycast(new Vector3(x, 500f, z), Vector3.down, out var hit), Is.True);
            return hit.point.y;
        }

        [Test]
        public void The_surface_is_the_height_map_at_the_objects_position()
        {
            Terrain(Slope(), new Vector3(10f, 1f, 20f));
            Assert.That(HeightAt(14f, 30f), Is.EqualTo(3f).Within(1e-3f));
            Assert.That(HeightAt(50.5f, 83.9f), Is.EqualTo(1f + 20.25f).Within(1e-3f));
            Assert.That(Physics.Raycast(new Vector3(9f, 500f, 30f), Vector3.down), Is.False, "a ray beside the terrain must not hit it");
        }

        [Test]
        public void Rotation_and_scale_of_the_object_are_ignored()
        {
            var terrain = Terrain(Slope(), Vector3.zero);
            terrain.transform.rotation = Quaternion.Euler(0f, 90f, 0f);
            terrain.transform.localScale = new Vector3(3f, 3f, 3f);
            Assert.That(HeightAt(20f, 40f), Is.EqualTo(10f).Within(1e-3f));
        }

        [Test]
        public void Changed_heights_change_the_surface()
        {
            var data = Slope();
            Terrain(data, Vector3.zero);
            Assert.That(HeightAt(20f, 40f), Is.EqualTo(10f).Within(1e-3f));
            data.size = new Vector3(64f, 50f, 64f);
            Assert.That(HeightAt(20f, 40f), Is.EqualTo(5f).Within(1e-3f));
            data.SetHeights(0, 0, new float[65, 65]);
            Assert.That(HeightAt(20f, 40f), Is.EqualTo(0f).Within(1e-3f));
        }

        [Test]
        public void A_terrain_that_had_no_shape_gets_one_when_its_data_become_valid()
        {
            var data = Slope();
            data.size = new Vector3(64f, float.NaN, 64f);
            Terrain(data, Vector3.zero);
            Physics.SyncTransforms();
            Assert.That(Errors.Count, Is.EqualTo(1));
            data.size = new Vector3(64f, 100f, 64f);
            Assert.That(HeightAt(20f, 40f), Is.EqualTo(10f).Within(1e-3f));
        }

        [Test]
        public void A_ball_lands_on_changed_heights()
        {
            var data = Slope();
            Terrain(data, Vector3.zero);
            var ball = Ball(new Vector3(32f, 18f, 32f));
            data.SetHeights(0, 0, new float[65, 65]);
            Run(4f);
            Assert.That(ball.position.y, Is.EqualTo(0.5f).Within(0.02f));
        }

        [Test]
        public void A_ball_rolls_down_the_slope_without_falling_through()
        {
            Terrain(Slope(), Vector3.zero);
            var ball = Ball(new Vector3(40f, 20.7f, 30f));
            Run(2f);
            Assert.That(ball.position.x, Is.LessThan(37f));
            Assert.That(ball.position.y, Is.EqualTo(0.5f * ball.position.x + 0.5f * Mathf.Sqrt(1.25f)).Within(0.1f));
        }

        [Test]
        public void The_resolution_is_rounded_to_a_power_of_two_plus_one()
        {
            var data = new TerrainData { heightmapResolution = 100 };
            Assert.That(data.heightmapResolution, Is.EqualTo(129));
            data.heightmapResolution = 1;
            Assert.That(data.heightmapResolution, Is.EqualTo(33));
            data.heightmapResolution = 9999;
            Assert.That(data.heightmapResolution, Is.EqualTo(4097));
        }

        [Test]
        public void Another_resolution_keeps_the_distance_between_samples()
        {
            var data = new TerrainData { size = new Vector3(64f, 10f, 32f) };
            data.heightmapResolution = 65;
            Assert.That(data.size, Is.EqualTo(new Vector3(128f, 10f, 64f)));
            Assert.That(data.heightmapScale, Is.EqualTo(new Vector3(2f, 10f, 1f)));
        }

        [Test]
        public void Heights_are_relative_to_the_size_and_clamped()
        {
            var data = new TerrainData { size = new Vector3(32f, 50f, 32f) };
            data.SetHeights(31, 32, new[,] { { 0.5f, 7f } });
            Assert.That(data.GetHeight(31, 32), Is.EqualTo(25f));
            Assert.That(data.GetHeight(32, 32), Is.EqualTo(50f));
            Assert.That(data.GetHeights(31, 32, 2, 1), Is.EqualTo(new[,] { { 0.5f, 1f } }));
            Assert.That(() => data.SetHeights(32, 0, new float[1, 2]), Throws.ArgumentException.With.Message.StringContaining("33 samples"));
        }

        [Test]
        public void A_terrain_on_a_non_kinematic_body_is_an_error()
        {
            var terrain = Terrain(Slope(), Vector3.zero);
            terrain.gameObject.AddComponent<Rigidbody>();
            Physics.SyncTransforms();
            Assert.That(Physics.Raycast(new Vector3(20f, 500f, 40f), Vector3.down), Is.False);
            Assert.That(Errors[0], Is.StringContaining("A TerrainCollider cannot be part of a Rigidbody that is not kinematic"));
        }
    }
}
