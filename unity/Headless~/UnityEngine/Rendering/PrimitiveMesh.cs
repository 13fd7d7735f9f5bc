using System;
using System.Collections.Generic;

namespace UnityEngine
{
    /// Unity's meshes of primitives. Spheres and capsules have Unity's surface, but other vertices.
    static class PrimitiveMesh
    {
        const int Sides = 24, Rings = 16;
        const int CylinderSides = 20;

        public static Mesh Create(PrimitiveType type)
        {
            var vertices = new List<Vector3>();
            var triangles = new List<int>();
            var size = Vector3.one;
            switch (type)
            {
                case PrimitiveType.Cube:
                    for (var side = 0; side < 6; side++) Grid(1, 1, (u, v) => OnCube(side, u, v));
                    break;
                case PrimitiveType.Plane:
                    Grid(10, 10, (u, v) => new Vector3(v - 5, 0f, u - 5));
                    size = new Vector3(10f, 0f, 10f);
                    break;
                case PrimitiveType.Quad:
                    Grid(1, 1, (u, v) => new Vector3(v - 0.5f, u - 0.5f, 0f));
                    size = new Vector3(1f, 1f, 0f);
                    break;
                case PrimitiveType.Sphere:
                    Grid(Rings, Sides, (u, v) => Turned(OnCircle(u), v, Sides));
                    break;
                case PrimitiveType.Capsule:
                    Grid(Rings + 1, Sides, (u, v) =>
                        Turned(u <= Rings / 2 ? OnCircle(u) + new Vector2(0f, -0.5f) : OnCircle(u - 1) + new Vector2(0f, 0.5f), v, Sides));
                    size = new Vector3(1f, 2f, 1f);
                    break;
                case PrimitiveType.Cylinder:
                    Grid(3, CylinderSides, (u, v) => Turned(new Vector2(u % 3 == 0 ? 0f : 0.5f, u < 2 ? -1f : 1f), v, CylinderSides));
                    size = new Vector3(1f, 2f, 1f);
                    break;
            }
            return new Mesh { name = type.ToString(), vertices = vertices.ToArray(), triangles = triangles.ToArray(), bounds = new Bounds(Vector3.zero, size) };

            // Adds a grid whose front side has u upwards and v to the right, without triangles of area 0.
            void Grid(int rows, int columns, Func<int, int, Vector3> at)
            {
                var first = vertices.Count;
                for (var u = 0; u <= rows; u++)
                    for (var v = 0; v <= columns; v++) vertices.Add(at(u, v));
                for (var u = 0; u < rows; u++)
                    for (var v = 0; v < columns; v++)
                    {
                        var corner = first + u * (columns + 1) + v;
                        Triangle(corner, corner + columns + 1, corner + columns + 2);
                        Triangle(corner, corner + columns + 2, corner + 1);
                    }
            }

            void Triangle(int a, int b, int c)
            {
                if (!vertices[a].Equals(vertices[b]) && !vertices[b].Equals(vertices[c]) && !vertices[c].Equals(vertices[a]))
                    triangles.AddRange(new[] { a, b, c });
            }
        }

        static Vector3 OnCube(int side, int u, int v)
        {
            var point = new Vector3();
            var front = side < 3;
            point[side % 3] = front ? 0.5f : -0.5f;
            point[(side + 1) % 3] = (front ? u : v) - 0.5f;
            point[(side + 2) % 3] = (front ? v : u) - 0.5f;
            return point;
        }

        /// Returns a point of the right half of a circle with radius 0.5, as radius and height. Row 0 is at the bottom.
        static Vector2 OnCircle(int row)
        {
            var angle = (row * 180f / Rings - 90f) * Mathf.Deg2Rad;
            return new Vector2(row % Rings == 0 ? 0f : 0.5f * Mathf.Cos(angle), 0.5f * Mathf.Sin(angle));
        }

        /// Turns a radius and height around the vertical axis, by a number of `sides` of a full turn.
        static Vector3 Turned(Vector2 point, int side, int sides)
        {
            var angle = side % sides * 360f / sides * Mathf.Deg2Rad;
            return new Vector3(point.x * Mathf.Cos(angle), point.y, point.x * Mathf.Sin(angle));
        }
    }
}
