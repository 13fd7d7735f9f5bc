using Collektive.Unity;
using crowd;
using UnityEngine;

namespace CollektiveSamples.Crowd
{
    /// <summary>Writes the walker's goal to the sensor data.</summary>
    [AddComponentMenu("Collektive/Samples/Crowd/Goal Sensor")]
    public sealed class GoalSensor : Sensor<SensorData>
    {
        [SerializeField]
        [Tooltip("Goal of the walker.")]
        private Vector3 goal;

        /// <summary>Goal of the walker.</summary>
        public Vector3 Goal
        {
            get => goal;
            set => goal = value;
        }

        /// <inheritdoc/>
        protected override void Sense(ref SensorData data) => data.Goal = goal;
    }
}
