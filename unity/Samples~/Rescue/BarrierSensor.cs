using System;
using Collektive.Unity;
using rescue;
using UnityEngine;

namespace CollektiveSamples.Rescue
{
    /// <summary>Detects walls, stones and vehicles, but not other robots and the ground, which are on another layer.</summary>
    [AddComponentMenu("Collektive/Samples/Rescue/Barrier Sensor")]
    public sealed class BarrierSensor : ObstacleSensor<SensorData>
    {
        /// <inheritdoc/>
        protected override void Write(ref SensorData data, Span<Obstacle> obstacles)
        {
            foreach (var obstacle in obstacles) data.Obstacles.Add(obstacle.Vector);
        }
    }
}
