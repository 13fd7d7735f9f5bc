using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Perceives the colliders within reach of the node's centre, other nodes' bodies included, its own and triggers not, with the closest point of
    /// each. Unity knows the closest point of boxes, spheres, capsules and convex meshes: keep others on a layer that is not looked at.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class ObstacleSensor<TData> : Sensor<TData>
    {
        private static Collider[] near = new Collider[32];
        private static Obstacle[] obstacles = new Obstacle[32];

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
            var centre = body.position;
            var count = Overlap(centre);
            var found = 0;
            for (var i = 0; i < count; i++)
            {
                var collider = near[i];
                if (collider.transform.IsChildOf(body)) continue;
                Insert(new Obstacle(collider, collider.ClosestPoint(centre) - centre), found++);
            }
            Write(ref data, new Span<Obstacle>(obstacles, 0, found));
        }

        /// <summary>Writes what there is, the nearest first. The obstacles are valid during the call only.</summary>
        protected abstract void Write(ref TData data, Span<Obstacle> obstacles);

        private int Overlap(Vector3 centre)
        {
            for (; ; )
            {
                var count = Physics.OverlapSphereNonAlloc(centre, reach, near, layers, QueryTriggerInteraction.Ignore);
                if (count < near.Length) return count;
                // A full array may have left some out.
                near = new Collider[near.Length * 2];
                obstacles = new Obstacle[near.Length];
            }
        }

        private static void Insert(in Obstacle obstacle, int count)
        {
            var place = count;
            for (; place > 0 && Touching.IsBefore(obstacle.Vector, obstacles[place - 1].Vector); place--) obstacles[place] = obstacles[place - 1];
            obstacles[place] = obstacle;
        }

        private void OnDrawGizmosSelected() => Gizmos.DrawWireSphere(transform.position, reach);
    }
}
