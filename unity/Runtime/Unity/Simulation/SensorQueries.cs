using System;
using Unity.Jobs;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// The physics queries of the ready-made sensors. A batch of rays and a batch of spheres run while the rules are called; queries that the batches
    /// cannot serve run one by one. Belongs to a simulation, and releases all colliders at the simulation's end.
    /// </summary>
    internal sealed class SensorQueries : IDisposable
    {
        /// <summary>Buffer for the colliders of a single query. If a query fills it, call <see cref="Grow"/> and repeat the query.</summary>
        internal Collider[] Near = new Collider[32];

        /// <summary>Buffer for the obstacles of a single query, with the same length as <see cref="Near"/>.</summary>
        internal Obstacle[] Obstacles = new Obstacle[32];

        /// <summary>Buffer for all hits of a single ray. If a query fills it, replace it by a longer one, and repeat the query.</summary>
        internal RaycastHit[] Hits = new RaycastHit[16];

        internal SensorQueries(Simulation simulation) => Sensors = new BatchedParts(simulation);

        /// <summary>The nearest hit of each ray.</summary>
        internal RayBatch Rays { get; } = new RayBatch(1);

        internal SphereBatch Spheres { get; } = new SphereBatch(8);

        internal BatchedParts Sensors { get; }

        /// <summary>Begins the batches of all sensors whose nodes are due. Do not change physics before <see cref="Finish"/>.</summary>
        internal void Begin()
        {
            Rays.Clear();
            Spheres.Clear();
            Sensors.Begin(isForDueNodes: true);
            Rays.Begin();
            Spheres.Begin();
            // Unity starts scheduled jobs only after this call.
            JobHandle.ScheduleBatchedJobs();
        }

        /// <summary>Waits for the results.</summary>
        internal void Finish()
        {
            Rays.Finish();
            Spheres.Finish();
        }

        /// <summary>Doubles the length of both buffers, and keeps their content.</summary>
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
