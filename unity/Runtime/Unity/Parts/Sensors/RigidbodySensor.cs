using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Perceives the node's own Rigidbody: its mass, velocities, rotation and other properties.</summary>
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

        /// <summary>Writes what the program shall know of the body.</summary>
        protected abstract void Write(ref TData data, Rigidbody body);
    }
}
