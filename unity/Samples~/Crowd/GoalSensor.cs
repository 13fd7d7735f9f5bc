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
        [Tooltip("Position in metres to which the walker goes.")]
        private Vector3 goal;

        /// <summary>Position in metres to which the walker goes.</summary>
        public Vector3 Goal
        {
            get => goal;
            set => goal = value;
        }

        /// <inheritdoc/>
        protected override void Sense(ref SensorData data) => data.Goal = goal;
    }
}
