using System;
using Collektive.Unity;
using gradientascent;
using UnityEngine;

namespace CollektiveSamples.GradientAscent
{
    /// <summary>Detects the colliders around the node: obstacles and the bodies of other nodes.</summary>
    [AddComponentMenu("Collektive/Samples/Gradient Ascent/Obstacle Sensor")]
    public sealed class ObstacleSensor : ObstacleSensor<SensorData>
    {
        /// <summary>Number of colliders that touched the node's body in its last round.</summary>
        public int Contacts { get; private set; }

        /// <summary>Radius of the node's body in metres.</summary>
        public float BodyRadius { get; set; } = 0.25f;

        /// <inheritdoc/>
        protected override void Write(ref SensorData data, Span<Obstacle> obstacles)
        {
            Contacts = 0;
            foreach (var obstacle in obstacles)
            {
                data.Obstacles.Add(obstacle.Vector);
                if (obstacle.Distance <= BodyRadius + 0.01f) Contacts++;
            }
        }
    }
}
