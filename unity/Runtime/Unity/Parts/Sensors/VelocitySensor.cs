using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Measures the velocity of the node's Rigidbody. If the node has no Rigidbody or a kinematic one, the sensor measures the mean velocity since the
    /// node's last round, which is zero in the first round.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class VelocitySensor<TData> : Sensor<TData>
    {
        private Rigidbody body;
        private Vector3 lastPosition;
        private double time = -1;
        private Vector3 meanVelocity;

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data) =>
            Write(ref data, body != null && !body.isKinematic ? body.linearVelocity : meanVelocity);

        internal sealed override void Attached() => time = -1;

        internal sealed override void Reparented() => body = FindBody();

        internal sealed override void NodeJoined() => time = -1;

        internal sealed override void Prepare(TickContext tick)
        {
            // Scripts may add the body after this component.
            if (time < 0) body = FindBody();
            var now = tick.Time;
            var here = Node.Position;
            meanVelocity = time >= 0 && now > time ? (here - lastPosition) / (float)(now - time) : Vector3.zero;
            lastPosition = here;
            time = now;
        }

        /// <summary>Writes the node's velocity in metres per second.</summary>
        protected abstract void Write(ref TData data, Vector3 velocity);
    }
}
