using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Sets the velocity of the node's body to the program's answer.</summary>
    /// <typeparam name="TData">As for <see cref="Actuator{TData}"/>.</typeparam>
    [RequireComponent(typeof(Rigidbody))]
    public abstract class SetVelocityActuator<TData> : Actuator<TData>
    {
        [SerializeField]
        [Tooltip("On: the body keeps its vertical velocity, so that it can fall.")]
        private bool keepVertical;

        private Rigidbody body;

        /// <summary>Whether the body keeps its vertical velocity, so that it can fall.</summary>
        public bool KeepVertical
        {
            get => keepVertical;
            set => keepVertical = value;
        }

        /// <inheritdoc/>
        protected override void OnEnable()
        {
            base.OnEnable();
            body = GetComponent<Rigidbody>();
        }

        /// <inheritdoc/>
        protected sealed override void Act(TData data)
        {
            var velocity = Finite(Read(data));
            // Setting the velocity of a kinematic body would make Unity log an error at each answer.
            if (WarnIfKinematic(body)) return;
            if (keepVertical) velocity.y = body.linearVelocity.y;
            body.linearVelocity = velocity;
        }

        /// <summary>Returns the velocity in the program's answer, in metres per second.</summary>
        protected abstract Vector3 Read(TData data);
    }
}
