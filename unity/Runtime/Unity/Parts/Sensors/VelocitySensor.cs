using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Measures the velocity of the node's Rigidbody. Without one, or with a kinematic one, it is the mean velocity since the node's
    /// last round (zero in its first).
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class VelocitySensor<TData> : Sensor<TData>
    {
        private Rigidbody body;
        private Vector3 place;
        private double time = -1;
        private Vector3 meanVelocity;

        /// <inheritdoc/>
        protected override void OnEnable()
        {
            base.OnEnable();
            body = GetComponentInParent<Rigidbody>();
            time = -1;
        }

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data) =>
            Write(ref data, body != null && !body.isKinematic ? body.linearVelocity : meanVelocity);

        internal sealed override void Prepare(TickContext tick)
        {
            var now = tick.Time;
            var here = Node.Position;
            meanVelocity = time >= 0 && now > time ? (here - place) / (float)(now - time) : Vector3.zero;
            place = here;
            time = now;
        }

        /// <summary>Writes the node's velocity in metres per second.</summary>
        protected abstract void Write(ref TData data, Vector3 velocity);
    }
}
