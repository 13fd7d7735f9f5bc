using System;
using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Standard
{
    /// <summary>The area of a deployment: its bounds, and the places in them that no obstacle covers.</summary>
    internal sealed class Area
    {
        private const int Attempts = 10000;

        private readonly Deployment deployment;
        private readonly List<Obstacle> obstacles;
        private readonly List<Vector3> places;
        private readonly float[] x;
        private readonly float[] z;

        /// <param name="places">The positions of nodes in the deployment's file at all times; empty for other kinds.</param>
        internal Area(Deployment deployment, List<Obstacle> obstacles, List<Vector3> places)
        {
            this.deployment = deployment;
            this.obstacles = obstacles;
            this.places = places;
            x = Bounds(0);
            z = Bounds(1);
        }

        internal static bool IsPoint(float[] point) => point.Length == 2 && IsFinite(point[0]) && IsFinite(point[1]);

        internal static bool IsSize(float[] size) => IsPoint(size) && size[0] > 0 && size[1] > 0;

        internal static bool IsFinite(float number) => !float.IsNaN(number) && !float.IsInfinity(number);

        /// <summary>The number of columns of a grid.</summary>
        internal int Columns => deployment.columns > 0 ? deployment.columns : Mathf.CeilToInt(Mathf.Sqrt(deployment.nodes));

        /// <summary>
        /// Returns the largest distance that two nodes can have if it would be <paramref name="radius"/> without rounding errors. The error of a coordinate
        /// is at most 2^-24 of it. Otherwise, nodes of a grid would miss many of their neighbours if the radius is the spacing, for example 1.1.
        /// </summary>
        internal float Rounded(float radius) => radius + Mathf.Max(-x[0], x[1], -z[0], z[1]) / (1 << 23) + radius / (1 << 22);

        /// <summary>Returns a free place with a uniform random distribution; null if almost no place is free.</summary>
        internal Vector3? Uniform(RandomStream random)
        {
            for (var attempt = 0; attempt < Attempts; attempt++)
            {
                var place = new Vector3(random.Range(x[0], x[1]), 0, random.Range(z[0], z[1]));
                if (Contains(place) && IsFree(place)) return place;
            }
            return null;
        }

        /// <summary>Returns whether a place is not covered by an obstacle.</summary>
        internal bool IsFree(Vector3 place)
        {
            foreach (var obstacle in obstacles)
            {
                var isInBox = obstacle.polygon.Count == 0 && Mathf.Abs(place.x - obstacle.box[0]) <= obstacle.size[0] / 2
                    && Mathf.Abs(place.z - obstacle.box[1]) <= obstacle.size[1] / 2;
                if (isInBox || obstacle.polygon.Count > 0 && (IsInside(obstacle.polygon, place) || IsInWall(obstacle.polygon, place))) return false;
            }
            return true;
        }

        /// <summary>Reflects a place and a direction at the bounding rectangle of the area.</summary>
        internal void Reflect(ref double placeX, ref double placeZ, ref Vector3 direction)
        {
            Reflect(ref placeX, ref direction.x, x);
            Reflect(ref placeZ, ref direction.z, z);
        }

        private static void Reflect(ref double place, ref float direction, float[] bounds)
        {
            if (place >= bounds[0] && place <= bounds[1]) return;
            // A fast node crosses the area several times in a tick. Two reflections shift the place by twice the side, and keep the direction.
            var shift = 2 * (bounds[1] - bounds[0]);
            var distance = place < bounds[0] ? bounds[0] - place : place - bounds[1];
            if (shift > 0 && distance > shift / 2) place -= shift * Math.Round((place - (bounds[0] + bounds[1]) / 2) / shift);
            if (place >= bounds[0] && place <= bounds[1]) return;
            place = Math.Min(Math.Max(place < bounds[0] ? 2 * bounds[0] - place : 2 * bounds[1] - place, bounds[0]), bounds[1]);
            direction = -direction;
        }

        private bool Contains(Vector3 place)
        {
            if (deployment.kind == DeploymentKind.Disc) return place.sqrMagnitude <= deployment.radius * deployment.radius;
            var isRectangle = deployment.kind == DeploymentKind.Grid || deployment.kind == DeploymentKind.File || deployment.polygon.Count == 0;
            return isRectangle || IsInside(deployment.polygon, place);
        }

        private float[] Bounds(int axis)
        {
            if (deployment.kind == DeploymentKind.Grid)
            {
                var count = axis == 0 ? Columns : (deployment.nodes + Columns - 1) / Columns;
                return new[] { -deployment.disorder, deployment.spacing * (count - 1) + deployment.disorder };
            }
            if (deployment.kind == DeploymentKind.File) return Bounds(places.ConvertAll(place => place[2 * axis]));
            if (deployment.kind == DeploymentKind.Disc || deployment.polygon.Count == 0)
            {
                var half = deployment.kind == DeploymentKind.Disc ? deployment.radius : deployment.size[axis] / 2;
                return new[] { -half, half };
            }
            return Bounds(deployment.polygon.ConvertAll(corner => corner[axis]));
        }

        private static float[] Bounds(List<float> coordinates)
        {
            var bounds = new[] { float.PositiveInfinity, float.NegativeInfinity };
            foreach (var coordinate in coordinates)
            {
                bounds[0] = Mathf.Min(bounds[0], coordinate);
                bounds[1] = Mathf.Max(bounds[1], coordinate);
            }
            return bounds;
        }

        /// <summary>Returns whether a place is in a wall along a side of a polygon. Half of each wall is outside the polygon.</summary>
        private static bool IsInWall(List<float[]> corners, Vector3 place)
        {
            for (int i = 0, before = corners.Count - 1; i < corners.Count; before = i++)
            {
                var corner = new Vector3(corners[before][0], 0, corners[before][1]);
                var side = new Vector3(corners[i][0], 0, corners[i][1]) - corner;
                var share = side.sqrMagnitude > 0 ? Mathf.Clamp01(Vector3.Dot(place - corner, side) / side.sqrMagnitude) : 0;
                if ((place - corner - share * side).magnitude <= StandardScene.WallWidth / 2) return true;
            }
            return false;
        }

        /// <summary>Returns whether a place is inside a polygon. A ray from such a place crosses the sides an odd number of times.</summary>
        private static bool IsInside(List<float[]> corners, Vector3 place)
        {
            var isInside = false;
            for (int i = 0, before = corners.Count - 1; i < corners.Count; before = i++)
            {
                var a = corners[i];
                var b = corners[before];
                if (a[1] > place.z == b[1] > place.z) continue;
                if (place.x < (b[0] - a[0]) * (place.z - a[1]) / (b[1] - a[1]) + a[0]) isInside = !isInside;
            }
            return isInside;
        }
    }
}
