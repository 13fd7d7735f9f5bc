using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Enables and disables a component, such as a light, a script, a renderer or a collider, as the program's answer demands.</summary>
    /// <typeparam name="TData">As for <see cref="Actuator{TData}"/>.</typeparam>
    public abstract class EnableActuator<TData> : Actuator<TData>
    {
        [SerializeField]
        [Tooltip("Component to enable and disable: a behaviour such as a script or light, a renderer or a collider.")]
        private Component target;

        /// <summary>The component to enable and disable: a behaviour, a renderer or a collider.</summary>
        public Component Target
        {
            get => target;
            set => target = value;
        }

        /// <inheritdoc/>
        protected sealed override void Act(TData data)
        {
            var on = Read(data);
            if (target is Behaviour behaviour) behaviour.enabled = on;
            else if (target is Renderer renderer) renderer.enabled = on;
            else if (target is Collider collider) collider.enabled = on;
            else throw new InvalidOperationException("its target is "
                + (target == null ? "not set" : "a " + target.GetType().Name + ", which cannot be enabled") + ": select a behaviour, a renderer or a collider");
        }

        /// <summary>Returns whether the program's answer enables the component.</summary>
        protected abstract bool Read(TData data);
    }
}
