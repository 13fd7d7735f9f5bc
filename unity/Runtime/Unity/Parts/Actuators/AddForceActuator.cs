using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Applies a force from the program's answer to the node's body. A force or an acceleration is multiplied by
    /// <see cref="Node.AnswerInterval"/>, and applied as one impulse before physics advances. An impulse or a velocity change is applied unchanged.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Actuator{TData}"/>.</typeparam>
    [RequireComponent(typeof(Rigidbody))]
    public abstract class AddForceActuator<TData> : Actuator<TData>
    {
        [SerializeField]
        [Tooltip("Kind of the answer: force in newtons, acceleration in m/s², impulse in newton seconds, or velocity change in m/s.")]
        private ForceMode mode = ForceMode.Force;

        private Rigidbody body;

        /// <summary>Kind of the answer: force, acceleration, impulse or velocity change.</summary>
        public ForceMode Mode
        {
            get => mode;
            set => mode = value;
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
            var push = Finite(Read(data));
            if (WarnIfKinematic(body)) return;
            // Unity would apply a force in one physics step only, but a tick may have several.
            if (mode == ForceMode.Force) body.AddForce(Node.AnswerInterval * push, ForceMode.Impulse);
            else if (mode == ForceMode.Acceleration) body.AddForce(Node.AnswerInterval * push, ForceMode.VelocityChange);
            else body.AddForce(push, mode);
        }

        /// <summary>Returns the force in the program's answer, in the unit of <see cref="Mode"/>, in world space.</summary>
        protected abstract Vector3 Read(TData data);
    }
}
