using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// A source of light, sound or smell. Its intensity decreases linearly with the distance, down to 0; a subclass may override <see cref="IntensityAt"/>.
    /// </summary>
    [AddComponentMenu("Collektive/Intensity Source")]
    [HelpPage("sensors-and-actuators.md#ready-made-components")]
    public class IntensitySource : MonoBehaviour
    {
        private static readonly List<IntensitySource> EnabledSources = new List<IntensitySource>();

        [SerializeField]
        [Min(0)]
        [Tooltip("Intensity at the source itself.")]
        private float peak = 100;

        [SerializeField]
        [Min(0)]
        [Tooltip("Decrease of the intensity per metre.")]
        private float falloff = 1;

        /// <summary>Intensity at the source itself, 0 or greater.</summary>
        public float Peak
        {
            get => peak;
            set => peak = value;
        }

        /// <summary>Decrease of the intensity per metre, 0 or greater.</summary>
        public float Falloff
        {
            get => falloff;
            set => falloff = value;
        }

        internal static List<IntensitySource> All => EnabledSources;

        /// <summary>Returns the intensity at a point, 0 or greater. Called for each node that senses the source; must not allocate.</summary>
        public virtual float IntensityAt(Vector3 point) => Mathf.Max(0, peak - falloff * Vector3.Distance(transform.position, point));

        /// <summary>Adds the source to the sources that sensors measure.</summary>
        protected virtual void OnEnable() => EnabledSources.Add(this);

        /// <summary>Removes the source from the sources that sensors measure.</summary>
        protected virtual void OnDisable() => EnabledSources.Remove(this);

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        private static void ResetStatics() => EnabledSources.Clear();

        private void OnDrawGizmosSelected()
        {
            if (falloff > 0) Gizmos.DrawWireSphere(transform.position, peak / falloff);
        }
    }
}
