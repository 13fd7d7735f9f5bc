using System;
using Collektive.Unity;
using crowd;
using UnityEngine;

namespace Collektive.Samples.Crowd
{
    /// <summary>Counts bumps into other walkers; the program does not hear of them.</summary>
    [AddComponentMenu("Collektive/Samples/Crowd/Bump Sensor")]
    public sealed class BumpSensor : ContactSensor<SensorData>
    {
        /// <summary>In how many rounds the walker touched another one.</summary>
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
