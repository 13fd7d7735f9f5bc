using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Perceives the colliders within reach of the node's centre, other nodes' bodies included, its own and triggers not, with the closest point of
    /// each. Unity knows the closest point of boxes, spheres, capsules and convex meshes; of others it is that of their bounds.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class ObstacleSensor<TData> : Sensor<TData>
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Metres from the node's centre.")]
        private float reach = 1;

        [SerializeField]
        [Tooltip("Layers to perceive.")]
        private LayerMask layers = Physics.DefaultRaycastLayers;

        /// <summary>Metres from the node's centre, 0 or greater.</summary>
        public float Reach
        {
            get => reach;
            set => reach = value;
        }

        /// <summary>Layers to perceive.</summary>
        public LayerMask Layers
        {
            get => layers;
            set => layers = value;
        }

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data)
        {
            var body = Node.Body;
            var centre = Node.Position;
            var memory = Node.Simulation.QueryMemory;
            var count = Overlap(centre, memory);
            var found = 0;
            for (var i = 0; i < count; i++)
            {
                var collider = memory.Near[i];
                if (collider.transform.IsChildOf(body)) continue;
                Insert(new Obstacle(collider, collider.PointClosestTo(centre) - centre), memory.Obstacles, found++);
            }
            Write(ref data, new Span<Obstacle>(memory.Obstacles, 0, found));
        }

        /// <summary>Writes what there is, the nearest first. The obstacles are valid during the call only.</summary>
        protected abstract void Write(ref TData data, Span<Obstacle> obstacles);

        private int Overlap(Vector3 centre, QueryMemory memory)
        {
            for (; ; )
            {
                var count = Physics.OverlapSphereNonAlloc(centre, reach, memory.Near, layers, QueryTriggerInteraction.Ignore);
                if (count < memory.Near.Length) return count;
                // A full array may have left some out.
                memory.Near = new Collider[2 * count];
                memory.Obstacles = new Obstacle[2 * count];
            }
        }

        private static void Insert(in Obstacle obstacle, Obstacle[] obstacles, int count)
        {
            var place = count;
            for (; place > 0 && Touching.IsBefore(obstacle.Vector, obstacles[place - 1].Vector); place--) obstacles[place] = obstacles[place - 1];
            obstacles[place] = obstacle;
        }

        private void OnDrawGizmosSelected() => Gizmos.DrawWireSphere(transform.position, reach);
    }
}
