using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine;

namespace CollektiveSamples.Rescue
{
    /// <summary>The ground of 80 x 50 m and everything on it: two buildings with rooms and doors, rubble, a dam with slopes, and vehicles.</summary>
    internal static class Ruins
    {
        /// <summary>Layer of the ground. Sensors and radio ignore this layer.</summary>
        internal const int GroundLayer = 2;

        private const float Height = 2.5f;
        private const float Thickness = 0.4f;
        private const float DoorWidth = 3;
        private const float SlopeDegrees = 14;

        // Each stone has one corner in each of these directions, so it is convex for all distances of the corners.
        private static readonly Vector3[] Axes = { Vector3.right, Vector3.left, Vector3.up, Vector3.down, Vector3.forward, Vector3.back };

        private static readonly int[] Faces = { 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5 };

        private static readonly Vector2[] Heaps =
        {
            new Vector2(-28, -14), new Vector2(-27, 16), new Vector2(-3, -3), new Vector2(9, 9), new Vector2(20, 18), new Vector2(34, 8), new Vector2(-4, -18),
        };

        /// <summary>Builds the ground and everything on it.</summary>
        internal static void Build(RandomStream random)
        {
            var ground = Box("Ground", new Vector3(0, -0.5f, 0), new Vector3(82, 1, 52));
            ground.layer = GroundLayer;
            WallAlongX(-25, -40, 40);
            WallAlongX(25, -40, 40);
            WallAlongZ(-40, -25, 25);
            WallAlongZ(40, -25, 25);
            // The northern building is a hall with two rooms.
            WallAlongX(4, -20, 4, -14, 0);
            WallAlongX(20, -20, 4);
            WallAlongZ(-20, 4, 20, 9);
            WallAlongZ(4, 4, 20, 15);
            WallAlongZ(-8, 4, 20, 16);
            // The southern building is a block with four rooms.
            WallAlongX(-21, 4, 34);
            WallAlongX(0, 4, 34, 12, 27);
            WallAlongZ(4, -21, 0, -16);
            WallAlongZ(34, -21, 0);
            WallAlongX(-11, 4, 34, 8, 30);
            WallAlongZ(19, -21, 0, -16, -4);
            Slope(-19.7f, SlopeDegrees);
            Slope(-14.3f, -SlopeDegrees);
            foreach (var heap in Heaps)
                for (var i = 0; i < 4; i++) Stone(heap + new Vector2(random.Range(-2f, 2f), random.Range(-2f, 2f)), random);
            Vehicle(new Vector3(6.5f, 0.8f, 3), new Vector3(6.5f, 0.8f, 22), 1.2f);
            Vehicle(new Vector3(-10, 0.8f, -9), new Vector3(1, 0.8f, -9), 0.8f);
            Vehicle(new Vector3(37, 0.8f, -22), new Vector3(37, 0.8f, 4), 1.5f);
        }

        private static void WallAlongX(float z, float from, float to, params float[] doors)
        {
            foreach (var (start, end) in Pieces(from, to, doors))
                Box("Wall", new Vector3((start + end) / 2, Height / 2, z), new Vector3(end - start + Thickness, Height, Thickness));
        }

        private static void WallAlongZ(float x, float from, float to, params float[] doors)
        {
            foreach (var (start, end) in Pieces(from, to, doors))
                Box("Wall", new Vector3(x, Height / 2, (start + end) / 2), new Vector3(Thickness, Height, end - start + Thickness));
        }

        /// <summary>Returns the pieces of a wall between its doors. The centres of the doors must be in ascending order.</summary>
        private static IEnumerable<(float Start, float End)> Pieces(float from, float to, float[] doors)
        {
            foreach (var door in doors)
            {
                yield return (from, door - DoorWidth / 2);
                from = door + DoorWidth / 2;
            }
            yield return (from, to);
        }

        /// <summary>Builds one side of the dam, which robots can climb.</summary>
        private static void Slope(float x, float degrees)
        {
            var slope = Box("Slope", new Vector3(x, 0.35f, -13.5f), new Vector3(5.8f, 0.4f, 22.5f));
            slope.transform.rotation = Quaternion.Euler(0, 0, degrees);
            slope.layer = GroundLayer;
        }

        private static void Stone(Vector2 place, RandomStream random)
        {
            var corners = new Vector3[Axes.Length];
            for (var i = 0; i < corners.Length; i++) corners[i] = random.Range(0.5f, 1.1f) * Axes[i];
            var mesh = new Mesh { name = "Stone", vertices = corners, triangles = Faces };
            mesh.RecalculateNormals();
            mesh.RecalculateBounds();
            var stone = GameObject.CreatePrimitive(PrimitiveType.Cube);
            stone.name = "Stone";
            stone.GetComponent<MeshFilter>().sharedMesh = mesh;
            Object.DestroyImmediate(stone.GetComponent<Collider>());
            var body = stone.AddComponent<MeshCollider>();
            body.convex = true;
            body.sharedMesh = mesh;
            stone.transform.SetPositionAndRotation(new Vector3(place.x, 0.4f, place.y), Quaternion.Euler(0, random.Range(0f, 360f), 0));
        }

        private static void Vehicle(Vector3 from, Vector3 to, float speed)
        {
            var vehicle = Box("Vehicle", from, new Vector3(1.4f, 1.6f, 1.4f));
            vehicle.SetActive(false);
            vehicle.AddComponent<Rigidbody>().isKinematic = true;
            vehicle.AddComponent<Shuttle>().Set(from, to, speed);
            vehicle.SetActive(true);
        }

        private static GameObject Box(string title, Vector3 centre, Vector3 size)
        {
            var box = GameObject.CreatePrimitive(PrimitiveType.Cube);
            box.name = title;
            box.transform.position = centre;
            box.transform.localScale = size;
            return box;
        }
    }
}
