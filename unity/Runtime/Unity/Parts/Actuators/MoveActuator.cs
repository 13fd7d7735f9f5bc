using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Moves the node towards the program's target, at most at its maximum speed. A Rigidbody is driven by its velocity; its vertical motion is left to
    /// gravity if the body uses it. A kinematic body and a node without a body are moved by position. A subclass selects
    /// the field of the schema's data that is the target.
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
        private bool isChecked;

        /// <summary>Speed limit in metres per second, 0 or greater.</summary>
        public float MaxSpeed
        {
            get => maxSpeed;
            set => maxSpeed = value;
        }

        /// <summary>Seconds to the target without the speed limit, 0 or greater.</summary>
        public float ReachTime
        {
            get => reachTime;
            set => reachTime = value;
        }

        /// <inheritdoc/>
        protected override void OnEnable()
        {
            base.OnEnable();
            body = GetComponentInParent<Rigidbody>();
        }

        /// <inheritdoc/>
        protected sealed override void Act(TData data)
        {
            var target = Finite(Read(data));
            if (body == null) MoveTowards(target);
            else if (body.isKinematic) body.MovePosition(body.position + Node.AnswerInterval * Velocity(target - body.position));
            else Drive(target - body.position);
        }

        /// <summary>Returns the target in the program's answer, in metres.</summary>
        protected abstract Vector3 Read(TData data);

        internal sealed override void Prepare(TickContext tick)
        {
            if (isChecked || body != null) return;
            isChecked = true;
            if (TryGetComponent<Collider>(out var obstacle) && !obstacle.isTrigger) tick.WarnMovedCollider(this);
        }

        private void MoveTowards(Vector3 target)
        {
            var place = Node.Body.position;
            Node.Body.position = place + Node.AnswerInterval * Velocity(target - place);
        }

        private void Drive(Vector3 way)
        {
            var fall = body.linearVelocity.y;
            if (body.useGravity) way.y = 0;
            var velocity = Velocity(way);
            if (body.useGravity) velocity.y = fall;
            body.linearVelocity = velocity;
        }

        private Vector3 Velocity(Vector3 way)
        {
            var length = way.magnitude;
            return length > 0 ? Mathf.Min(1 / Mathf.Max(reachTime, Node.AnswerInterval), maxSpeed / length) * way : way;
        }
    }
}
