using System;
using Collektive.Unity;
using crowd;
using UnityEngine;

namespace CollektiveSamples.Crowd
{
    /// <summary>Counts collisions with other walkers. The program does not receive them.</summary>
    [AddComponentMenu("Collektive/Samples/Crowd/Bump Sensor")]
    public sealed class BumpSensor : ContactSensor<SensorData>
    {
        /// <summary>Number of rounds with a collision.</summary>
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
