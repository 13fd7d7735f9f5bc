using System;
using Collektive.Unity;
using crowd;
using UnityEngine;

namespace CollektiveSamples.Crowd
{
    /// <summary>Detects walls and pillars, but not walkers, which are on another layer. The program receives the walkers' data in messages.</summary>
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
