using System.Collections.Generic;
using Collektive.Unity;
using rescue;
using UnityEngine;

namespace CollektiveSamples.Rescue
{
    /// <summary>Detects the first casualty that is near and visible. Also writes whether the node is the base.</summary>
    [AddComponentMenu("Collektive/Samples/Rescue/Casualty Sensor")]
    public sealed class CasualtySensor : Sensor<SensorData>
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Range of the sensor in metres.")]
        private float reach = 4;

        [SerializeField]
        [Tooltip("On: this node is the base.")]
        private bool isBase;

        private IReadOnlyList<Vector3> casualties;

        /// <summary>The positions of the casualties in metres.</summary>
        public IReadOnlyList<Vector3> Casualties
        {
            set => casualties = value;
        }

        /// <summary>Whether this node is the base.</summary>
        public bool IsBase
        {
            set => isBase = value;
        }

        /// <inheritdoc/>
        protected override void Sense(ref SensorData data)
        {
            data.Base = isBase;
            data.Casualty = InSight();
        }

        private int InSight()
        {
            var here = transform.position;
            for (var i = 0; i < casualties.Count; i++)
            {
                if (Vector3.Distance(here, casualties[i]) <= reach && !Physics.Linecast(here, casualties[i])) return i;
            }
            return -1;
        }
    }
}
