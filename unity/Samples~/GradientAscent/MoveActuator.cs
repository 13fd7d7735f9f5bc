using Collektive.Unity;
using gradientascent;
using UnityEngine;

namespace Collektive.Samples.GradientAscent
{
    /// <summary>Drives the node's rigid body towards the program's target, on the ground, as fast as it may.</summary>
    [AddComponentMenu("Collektive/Samples/Move Actuator")]
    [RequireComponent(typeof(Rigidbody))]
    public sealed class MoveActuator : Actuator<ActuatorDataValue>
    {
        [SerializeField]
        [Min(0)]
        [Tooltip("Metres per second.")]
        private float maxSpeed = 5;

        [SerializeField]
        [Min(0.01f)]
        [Tooltip("Seconds in which the body would reach its target if it were fast enough.")]
        private float reachTime = 0.5f;

        private Rigidbody body;

        /// <inheritdoc/>
        protected override void OnEnable()
        {
            base.OnEnable();
            body = GetComponent<Rigidbody>();
        }

        /// <inheritdoc/>
        protected override void Act(ActuatorDataValue data)
        {
            var way = data.Target.ToUnity() - body.position;
            way.y = 0;
            var velocity = Vector3.ClampMagnitude(way / reachTime, maxSpeed);
            // Falling is left to gravity.
            velocity.y = body.linearVelocity.y;
            body.linearVelocity = velocity;
        }
    }
}
