using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Measures the node's Rigidbody: its mass, velocities, rotation and other properties.</summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    [RequireComponent(typeof(Rigidbody))]
    public abstract class RigidbodySensor<TData> : Sensor<TData>
    {
        private Rigidbody body;

        /// <inheritdoc/>
        protected override void OnEnable()
        {
            base.OnEnable();
            body = GetComponent<Rigidbody>();
        }

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data) => Write(ref data, body);

        /// <summary>Writes the properties of the body that the program needs.</summary>
        protected abstract void Write(ref TData data, Rigidbody body);
    }
}
