using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Standard
{
    /// <summary>Kinds of deployments. A grid begins at the origin. Discs and rectangles have their centre there.</summary>
    public enum DeploymentKind
    {
        /// <summary>Positions in rows and columns, moved at random by up to <see cref="Deployment.disorder"/>.</summary>
        Grid,

        /// <summary>Uniform random positions in a disc.</summary>
        Disc,

        /// <summary>Uniform random positions in a rectangle or polygon.</summary>
        Uniform,

        /// <summary>Uniform random positions in a rectangle or polygon, with a minimum distance between nodes.</summary>
        Poisson,

        /// <summary>The positions in a file.</summary>
        File,
    }

    /// <summary>The initial positions of nodes.</summary>
    public sealed class Deployment
    {
        public DeploymentKind kind = DeploymentKind.Grid;
        public int nodes = 100;

        /// <summary>Distance between the nodes of a grid in metres. For Poisson, the minimum distance.</summary>
        public float spacing = 3;

        /// <summary>Number of columns of a grid; 0 for a square grid.</summary>
        public int columns;

        /// <summary>Maximum random offset of the nodes of a grid along each axis in metres.</summary>
        public float disorder;

        /// <summary>Radius of a disc in metres.</summary>
        public float radius = 15;

        /// <summary>Size of a rectangle in metres along x and z.</summary>
        public float[] size = { 30, 30 };

        /// <summary>Corners of a polygon as [x, z]; empty for a rectangle.</summary>
        public List<float[]> polygon = new List<float[]>();

        /// <summary>For the kind File, a CSV, GeoJSON or GPX file in the scenario's data folder.</summary>
        public string file = "";
    }

    /// <summary>The source of the sensor data "reading": an expression or a file. Without a value, the reading is 0.</summary>
    public sealed class Reading
    {
        /// <summary>An SQL expression with the columns id, time, x, y and z.</summary>
        public string expression = "";

        /// <summary>A CSV file in the scenario's data folder, with the column value, and optionally id and time.</summary>
        public string file = "";
    }

    /// <summary>A named set of nodes. It contains nodes with certain ids, and the nodes that are nearest to a point at the start.</summary>
    public sealed class NodeSet
    {
        public string name = "";
        public int[] ids = { };

        /// <summary>The point as [x, z]; empty if the set contains only the ids.</summary>
        public float[] near = { };

        /// <summary>Number of nodes nearest to the point.</summary>
        public int count = 1;

        /// <summary>Simulated second at which nodes enter the set.</summary>
        public double from;

        /// <summary>Simulated second at which nodes leave the set.</summary>
        public double until = 1e9;
    }

    /// <summary>A box, or walls along the sides of a polygon.</summary>
    public sealed class Obstacle
    {
        /// <summary>Centre of a box as [x, z].</summary>
        public float[] box = { };

        /// <summary>Size of a box in metres along x and z.</summary>
        public float[] size = { 1, 1 };

        /// <summary>Corners of a polygon as [x, z].</summary>
        public List<float[]> polygon = new List<float[]>();

        /// <summary>Height in metres.</summary>
        public float height = 3;
    }

    /// <summary>Kinds of neighbourhood rules.</summary>
    public enum NeighbourhoodKind
    {
        /// <summary>Links nodes within a radius.</summary>
        Radius,

        /// <summary>Links each node with the nearest ones.</summary>
        Nearest,

        /// <summary>Links nodes within a radius if no obstacle is between them.</summary>
        LineOfSight,
    }

    /// <summary>The neighbourhood rule of all nodes.</summary>
    public sealed class Neighbourhood
    {
        public NeighbourhoodKind kind = NeighbourhoodKind.Radius;

        /// <summary>Radius in metres, for Radius and LineOfSight.</summary>
        public float radius = 4;

        /// <summary>Number of neighbours, for Nearest.</summary>
        public int count = 8;

        /// <summary>Change in metres above which programs receive the new length of a link.</summary>
        public float lengthTolerance = 0.25f;
    }

    /// <summary>Kinds of movement.</summary>
    public enum MovementKind
    {
        /// <summary>Nodes do not move.</summary>
        None,

        /// <summary>Nodes move from one uniform random point of the area to the next.</summary>
        RandomWaypoint,

        /// <summary>Nodes move on straight lines, whose lengths follow a power law and whose directions are uniform. The area's bounds reflect them.</summary>
        LevyWalk,

        /// <summary>The program's answer is a velocity. Nodes move with it as physical bodies.</summary>
        Velocity,

        /// <summary>The program's answer is a target position. Nodes move towards it as physical bodies.</summary>
        Target,

        /// <summary>Nodes follow the positions and times in the deployment's file.</summary>
        Trace,
    }

    /// <summary>The movement of all nodes.</summary>
    public sealed class Movement
    {
        public MovementKind kind = MovementKind.None;

        /// <summary>Speed in metres per second. For Target, the maximum speed.</summary>
        public float speed = 1;

        /// <summary>Simulated seconds for which a node waits at each waypoint.</summary>
        public float pause;

        /// <summary>Exponent of the power law of a Lévy walk, greater than 1.</summary>
        public float exponent = 2;

        /// <summary>Length of the shortest line of a Lévy walk in metres.</summary>
        public float shortest = 1;

        /// <summary>Radius of the nodes' bodies in metres, for Velocity and Target.</summary>
        public float bodyRadius = 0.25f;
    }

    /// <summary>The rates at which nodes leave and join during the run.</summary>
    public sealed class Churn
    {
        /// <summary>Failures per node and simulated second.</summary>
        public float failures;

        /// <summary>New nodes per simulated second. They appear at uniform random positions in the area.</summary>
        public float arrivals;
    }
}
