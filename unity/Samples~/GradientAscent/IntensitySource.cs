using UnityEngine;

namespace Collektive.Samples.GradientAscent
{
    /// <summary>The place that the swarm looks for: its intensity falls by one with each metre.</summary>
    [AddComponentMenu("Collektive/Samples/Intensity Source")]
    public sealed class IntensitySource : MonoBehaviour
    {
        [SerializeField]
        [Tooltip("Intensity at the source itself.")]
        private float peak = 100;

        /// <summary>The intensity at a point.</summary>
        public float IntensityAt(Vector3 point) => peak - Vector3.Distance(transform.position, point);
    }
}
