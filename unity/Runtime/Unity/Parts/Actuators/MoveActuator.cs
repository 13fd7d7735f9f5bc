using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Moves the node towards a target in the program's answer, at no more than a maximum speed. For a node with a Rigidbody, it sets the velocity, but
    /// leaves the vertical motion to gravity if the body uses gravity. It moves a kinematic body in each physics step, until the node's next answer. For
    /// a node without a body, it sets the position. A subclass selects the field of the schema's data that contains the target.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Actuator{TData}"/>.</typeparam>
    public abstract class MoveActuator<TData> : Actuator<TData>
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Speed limit in metres per second.")]
        private float maxSpeed = 5;

        [SerializeField]
        [Min(0)]
        [Tooltip("Seconds to the target without the speed limit. Longer times slow the node down earlier.")]
        private float reachTime = 0.5f;

        private Rigidbody body;
        // The transform of a body that the node is a child of; null if the body is the node's.
        private Transform carrier;
        private bool isChecked;

        /// <summary>Speed limit in metres per second, 0 or greater.</summary>
        public float MaxSpeed
        {
            get => maxSpeed;
            set => maxSpeed = value;
        }

        /// <summary>Seconds in which the node would reach the target without the speed limit, 0 or greater.</summary>
        public float ReachTime
        {
            get => reachTime;
            set => reachTime = value;
        }

        /// <inheritdoc/>
        protected sealed override void Act(TData data)
        {
            var target = Finite(Read(data));
            CheckNotNegative("maximum speed", maxSpeed);
            CheckNotNegative("reach time", reachTime);
            if (body == null)
            {
                MoveTowards(target);
                return;
            }
            var offset = target - Position;
            if (body.isKinematic) Node.Simulation.Context.Steps.Move(this, body, offset, Velocity(offset, Node.AnswerInterval));
            else Drive(offset);
        }

        /// <summary>Returns the target in the program's answer, in metres.</summary>
        protected abstract Vector3 Read(TData data);

        internal sealed override void Attached() => isChecked = false;

        internal sealed override void Reparented() => isChecked = false;

        internal sealed override void Prepare(TickContext tick)
        {
            if (isChecked) return;
            isChecked = true;
            // Scripts may have added bodies and nodes after this component.
            SelectBody();
            if (body == null && TryGetComponent<Collider>(out var obstacle) && !obstacle.isTrigger) tick.WarnMovedCollider(this);
        }

        private Vector3 Position => carrier is null ? body.position : body.position + (Node.Body.position - carrier.position);

        private void SelectBody()
        {
            body = FindBody();
            carrier = body != null && body.transform != Node.transform && Node.transform.IsChildOf(body.transform) ? body.transform : null;
        }

        private void MoveTowards(Vector3 target)
        {
            var position = Node.Body.position;
            var interval = Node.AnswerInterval;
            Node.Body.position = position + interval * Velocity(target - position, interval);
        }

        private void Drive(Vector3 offset)
        {
            var fall = body.linearVelocity.y;
            if (body.useGravity) offset.y = 0;
            // The body keeps the velocity until the next round.
            var velocity = Velocity(offset, Mathf.Max(Node.AnswerInterval, Node.LongestInterval));
            if (body.useGravity) velocity.y = fall;
            body.linearVelocity = velocity;
        }

        /// <summary>Returns the velocity with which the node does not pass its target in <paramref name="seconds"/>.</summary>
        private Vector3 Velocity(Vector3 offset, float seconds)
        {
            var length = offset.magnitude;
            // The square of the length overflowed, so only the direction matters.
            if (float.IsInfinity(length)) return maxSpeed * (1e-20f * offset).normalized;
            return length > 0 ? Mathf.Min(1 / Mathf.Max(reachTime, seconds), maxSpeed / length) * offset : offset;
        }
    }
}
