using System;
using Collektive.Unity;
using crowd;
using UnityEngine;

namespace CollektiveSamples.Crowd
{
    /// <summary>Counts collisions with other walkers for the metrics. The program does not receive the number.</summary>
    [AddComponentMenu("Collektive/Samples/Crowd/Bump Sensor")]
    public sealed class BumpSensor : ContactSensor<SensorData>
    {
        /// <summary>Number of rounds in which the walker has touched another one.</summary>
        public int Rounds { get; private set; }

        /// <inheritdoc/>
        protected override void Write(ref SensorData data, Span<Contact> contacts)
        {
            foreach (var contact in contacts)
            {
                if (contact.Body == null) continue;
                Rounds++;
                return;
            }
        }
    }
}
