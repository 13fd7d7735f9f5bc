using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The services of a simulation that parts use during a tick. Call all members from the main thread.</summary>
    internal sealed class TickContext
    {
        private readonly Simulation simulation;
        private bool hasWarnedMovedCollider;

        internal TickContext(Simulation simulation)
        {
            this.simulation = simulation;
            Links = new NeighbourSearch();
            Grid = new NodeGrid(Links);
            Neighbours = new NeighbourCollector(simulation.Nodes, Grid);
            SightLines = new SightLines(simulation);
            Queries = new SensorQueries(simulation);
        }

        /// <summary>Simulated seconds at the beginning of the tick.</summary>
        internal double Time => simulation.Time;

        /// <summary>All links, and searches for near nodes.</summary>
        internal NeighbourSearch Links { get; }

        /// <summary>Positions of the nodes in this tick. Up to date from the start of the queries to the end of the rules.</summary>
        internal NodeGrid Grid { get; }

        /// <summary>The collector that rules add neighbours to.</summary>
        internal NeighbourCollector Neighbours { get; }

        /// <summary>Sight lines between nodes.</summary>
        internal SightLines SightLines { get; }

        /// <summary>The physics queries of sensors.</summary>
        internal SensorQueries Queries { get; }

        /// <summary>The physics steps at the end of the tick.</summary>
        internal PhysicsSteps Steps { get; } = new PhysicsSteps();

        /// <summary>Buffer for sensors.</summary>
        internal SensorBuffer SensorData => simulation.SensorData;

        /// <summary>Buffer for actuators.</summary>
        internal ActuatorBuffer Answered => simulation.Answered;

        /// <summary>Ends the simulation with an error. Clicking the message selects the part.</summary>
        internal void Fail(string message, NodePart part) => simulation.Fail(message, part);

        /// <summary>Warns about the first part that moves a collider without a Rigidbody, because such a collider passes through other objects.</summary>
        internal void WarnMovedCollider(NodePart part)
        {
            if (hasWarnedMovedCollider) return;
            hasWarnedMovedCollider = true;
            Debug.LogWarning(part.GetType().Name + " moves '" + part.name + "', a collider without a Rigidbody, through walls and other nodes: "
                + "add a Rigidbody, or make the collider a trigger", part);
        }

        /// <summary>Releases the memory of searches and queries.</summary>
        internal void Release()
        {
            SightLines.Dispose();
            Queries.Dispose();
            Links.Dispose();
        }
    }
}
