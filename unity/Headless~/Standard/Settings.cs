using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Standard
{
    /// <summary>How nodes are placed. A grid begins at the origin. Discs and rectangles are centred there.</summary>
    public enum DeploymentKind
    {
        /// <summary>Rows and columns, with <see cref="Deployment.disorder"/>.</summary>
        Grid,

        /// <summary>Uniform in a disc.</summary>
        Disc,

        /// <summary>Uniform in a rectangle or polygon.</summary>
        Uniform,

        /// <summary>Uniform in a rectangle or polygon, with a smallest distance between nodes.</summary>
        Poisson,

        /// <summary>At the places in a file.</summary>
        File,
    }

    /// <summary>Where nodes start.</summary>
    public sealed class Deployment
    {
        public DeploymentKind kind = DeploymentKind.Grid;
        public int nodes = 100;

        /// <summary>Metres between the nodes of a grid, or the smallest distance for Poisson.</summary>
        public float spacing = 3;

        /// <summary>Columns of a grid; 0: as many as rows.</summary>
        public int columns;

        /// <summary>Metres by which a node of a grid may be off its place, along each axis.</summary>
        public float disorder;

        /// <summary>Metres, of a disc.</summary>
        public float radius = 15;

        /// <summary>Metres along x and z, of a rectangle.</summary>
        public float[] size = { 30, 30 };

        /// <summary>Corners, [x, z] each; none: a rectangle.</summary>
        public List<float[]> polygon = new List<float[]>();

        /// <summary>A CSV, GeoJSON or GPX file in the scenario's folder of data, of File.</summary>
        public string file = "";
    }

    /// <summary>The sensor data "reading": an expression, or values from a file; 0 without a value.</summary>
    public sealed class Reading
    {
        /// <summary>SQL with the columns id, time, x, y and z.</summary>
        public string expression = "";

        /// <summary>A CSV file in the scenario's folder of data, with the columns value, and optionally id and time.</summary>
        public string file = "";
    }

    /// <summary>A named set of nodes: given ids, and the nodes nearest to a point at the start.</summary>
    public sealed class NodeSet
    {
        public string name = "";
        public int[] ids = { };

        /// <summary>[x, z]; none: the ids alone.</summary>
        public float[] near = { };

        /// <summary>How many nodes nearest to the point.</summary>
        public int count = 1;

        /// <summary>Simulated seconds from which nodes are in the set.</summary>
        public double from;

        /// <summary>Simulated seconds from which they no longer are.</summary>
        public double until = 1e9;
    }

    /// <summary>A box, or walls along the sides of a polygon.</summary>
    public sealed class Obstacle
    {
        /// <summary>Centre of a box, [x, z].</summary>
        public float[] box = { };

        /// <summary>Metres along x and z, of a box.</summary>
        public float[] size = { 1, 1 };

        /// <summary>Corners, [x, z] each.</summary>
        public List<float[]> polygon = new List<float[]>();

        /// <summary>Metres.</summary>
        public float height = 3;
    }

    /// <summary>The rule that links nodes.</summary>
    public enum NeighbourhoodKind
    {
        /// <summary>Those within a radius.</summary>
        Radius,

        /// <summary>The nearest ones.</summary>
        Nearest,

        /// <summary>Those within a radius, without an obstacle on the line between them.</summary>
        LineOfSight,
    }

    /// <summary>The neighbourhood rule of all nodes.</summary>
    public sealed class Neighbourhood
    {
        public NeighbourhoodKind kind = NeighbourhoodKind.Radius;

        /// <summary>Metres, of Radius and LineOfSight.</summary>
        public float radius = 4;

        /// <summary>Nodes, of Nearest.</summary>
        public int count = 8;
    }

    /// <summary>The way in which nodes move.</summary>
    public enum MovementKind
    {
        /// <summary>Nothing.</summary>
        None,

        /// <summary>To uniform points of the area, one after the other.</summary>
        RandomWaypoint,

        /// <summary>Straight ways of power-law lengths in uniform directions, reflected by the area's bounds.</summary>
        LevyWalk,

        /// <summary>The program's velocity, by physics.</summary>
        Velocity,

        /// <summary>The program's target, by physics.</summary>
        Target,

        /// <summary>The times in the deployment's file.</summary>
        Trace,
    }

    /// <summary>How nodes move.</summary>
    public sealed class Movement
    {
        public MovementKind kind = MovementKind.None;

        /// <summary>Metres per second; the greatest speed of Target.</summary>
        public float speed = 1;

        /// <summary>Simulated seconds at each waypoint.</summary>
        public float pause;

        /// <summary>Exponent of the lengths of a Lévy walk, above 1.</summary>
        public float exponent = 2;

        /// <summary>Shortest length of a Lévy walk in metres.</summary>
        public float shortest = 1;

        /// <summary>Metres: radius of the nodes' bodies, of Velocity and Target.</summary>
        public float bodyRadius = 0.25f;
    }

    /// <summary>Nodes that leave and join during the run.</summary>
    public sealed class Churn
    {
        /// <summary>Failures per node and simulated second.</summary>
        public float failures;

        /// <summary>New nodes per simulated second, uniform in the area.</summary>
        public float arrivals;
    }
}
