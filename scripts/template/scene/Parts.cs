using Collektive.Unity;
using UnityEngine;

namespace template
{
    /// <summary>Senses whether the node is a source.</summary>
    public sealed class SourceSensor : Sensor<SensorData>
    {
        /// <summary>Whether this node is a source.</summary>
        public bool isSource;

        /// <inheritdoc/>
        protected override void Sense(ref SensorData data) => data.Source = isSource;
    }

    /// <summary>Colours the node by its distance.</summary>
    public sealed class DistanceHue : Actuator<ActuatorData>
    {
        /// <inheritdoc/>
        protected override void Act(ActuatorData data) =>
            GetComponent<Renderer>().material.color = data.Distance < 0 ? Color.grey : Color.HSVToRGB(Mathf.Min(data.Distance / 50, 0.8f), 1, 1);
    }

    /// <summary>Moves in a straight line, and turns back at the sides of a square.</summary>
    public sealed class Wanderer : MonoBehaviour
    {
        private float side;
        private Vector3 velocity;

        internal void Begin(float side, float speed, float angle)
        {
            this.side = side;
            velocity = speed * new Vector3(Mathf.Cos(angle), 0, Mathf.Sin(angle));
        }

        internal void Move(float seconds)
        {
            var place = transform.position + seconds * velocity;
            if (place.x < 0 || place.x > side) velocity.x = -velocity.x;
            if (place.z < 0 || place.z > side) velocity.z = -velocity.z;
            transform.position = new Vector3(Mathf.Clamp(place.x, 0, side), place.y, Mathf.Clamp(place.z, 0, side));
        }
    }
}
