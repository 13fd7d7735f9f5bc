using Collektive.Unity;
using gradientascent;
using UnityEngine;

namespace Collektive.Samples.GradientAscent
{
    /// <summary>
    /// Perceives colliders around the node, obstacles and other bodies alike: the vector from the node's centre to the closest point of
    /// each one within reach.
    /// </summary>
    [AddComponentMenu("Collektive/Samples/Obstacle Sensor")]
    public sealed class ObstacleSensor : Sensor<SensorDataDraft>
    {
        private static Collider[] hits = new Collider[32];
        private static Vector3[] vectors = new Vector3[32];

        [SerializeField]
        [Min(0)]
        [Tooltip("Metres from the node's centre.")]
        private float reach = 1;

        [SerializeField]
        [Tooltip("Layers to perceive.")]
        private LayerMask layers = Physics.DefaultRaycastLayers;

        /// <summary>Colliders that touch the node's own body at the last tick: closest points within a radius of the centre.</summary>
        public int Contacts { get; private set; }

        /// <summary>Radius of the node's body in metres.</summary>
        public float BodyRadius { get; set; } = 0.25f;

        /// <inheritdoc/>
        protected override void Sense(ref SensorDataDraft data)
        {
            var centre = transform.position;
            var count = Overlap(centre);
            var found = 0;
            Contacts = 0;
            for (var i = 0; i < count; i++)
            {
                if (hits[i].transform == transform) continue;
                var vector = hits[i].ClosestPoint(centre) - centre;
                if (vector.magnitude <= BodyRadius + 0.01f) Contacts++;
                Insert(vector, found++);
            }
            for (var i = 0; i < found; i++) data.Obstacles.Add(vectors[i].ToValue());
        }

        private int Overlap(Vector3 centre)
        {
            for (; ; )
            {
                var count = Physics.OverlapSphereNonAlloc(centre, reach, hits, layers, QueryTriggerInteraction.Ignore);
                if (count < hits.Length) return count;
                // A full array may have left some out.
                hits = new Collider[hits.Length * 2];
                vectors = new Vector3[hits.Length];
            }
        }

        /// <summary>Unity gives overlaps in no defined order; sums of floats repeat only in a defined one.</summary>
        private static void Insert(Vector3 vector, int count)
        {
            var place = count;
            for (; place > 0 && Before(vector, vectors[place - 1]); place--) vectors[place] = vectors[place - 1];
            vectors[place] = vector;
        }

        private static bool Before(Vector3 a, Vector3 b)
        {
            if (a.x != b.x) return a.x < b.x;
            return a.z != b.z ? a.z < b.z : a.y < b.y;
        }
    }
}
