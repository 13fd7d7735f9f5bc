using System;
using Collektive.Unity;
using crowd;
using UnityEngine;

namespace CollektiveSamples.Crowd
{
    /// <summary>Detects walls and pillars. Walkers are on another layer and are known from their messages.</summary>
    [AddComponentMenu("Collektive/Samples/Crowd/Wall Sensor")]
    public sealed class WallSensor : ObstacleSensor<SensorData>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorData data, Span<Obstacle> obstacles)
        {
            foreach (var obstacle in obstacles) data.Obstacles.Add(obstacle.Vector);
        }
    }
}
