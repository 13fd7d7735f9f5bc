using System;
using Unity.Jobs;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// The physics queries of the ready-made sensors: one batch of rays and one of spheres, which run while the rules are called, and single queries where a
    /// batch is not enough. It belongs to the simulation and keeps no collider after its end.
    /// </summary>
    internal sealed class SensorQueries : IDisposable
    {
        /// <summary>The colliders of one query at a time. If a query fills it, <see cref="Grow"/> it and query again.</summary>
        internal Collider[] Near = new Collider[32];

        /// <summary>The obstacles of that query; the array has the same length.</summary>
        internal Obstacle[] Obstacles = new Obstacle[32];

        internal SensorQueries(Simulation simulation) => Sensors = new BatchedParts(simulation);

        /// <summary>The nearest hit of each ray.</summary>
        internal RayBatch Rays { get; } = new RayBatch(1);

        internal SphereBatch Spheres { get; } = new SphereBatch(8);

        internal BatchedParts Sensors { get; }

        /// <summary>Begins the batches of all sensors whose nodes are due. Physics may not be changed before <see cref="Finish"/>.</summary>
        internal void Begin()
        {
            Rays.Clear();
            Spheres.Clear();
            Sensors.Begin(isForDueNodes: true);
            Rays.Begin();
            Spheres.Begin();
            // Unity does not start scheduled jobs before this call.
            JobHandle.ScheduleBatchedJobs();
        }

        /// <summary>Waits for the results.</summary>
        internal void Finish()
        {
            Rays.Finish();
            Spheres.Finish();
        }

        /// <summary>Doubles the length of both arrays, and keeps their content.</summary>
        internal void Grow()
        {
            Array.Resize(ref Near, 2 * Near.Length);
            Array.Resize(ref Obstacles, Near.Length);
        }

        /// <inheritdoc/>
        public void Dispose()
        {
            Rays.Dispose();
            Spheres.Dispose();
        }
    }
}
