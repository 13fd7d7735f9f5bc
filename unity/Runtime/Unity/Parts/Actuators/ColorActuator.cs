using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Colours the node by the program's answer.</summary>
    /// <typeparam name="TData">As for <see cref="Actuator{TData}"/>.</typeparam>
    public abstract class ColorActuator<TData> : Actuator<TData>, IColors
    {
        [SerializeField]
        [Tooltip("What is coloured. None: the first renderer on this GameObject or its children.")]
        private Renderer target;

        /// <summary>What is coloured; null before the component was enabled: it finds the first renderer on this GameObject or its children.</summary>
        public Renderer Target
        {
            get => target;
            set => target = value;
        }

        /// <inheritdoc/>
        protected override void OnEnable()
        {
            base.OnEnable();
            if (target == null) target = GetComponentInChildren<Renderer>();
            if (target != null) return;
            Debug.LogError(GetType().Name + " on '" + name + "' finds no Renderer to colour: name one, or add one to the GameObject", this);
            enabled = false;
        }

        /// <inheritdoc/>
        protected sealed override void Act(TData data) => target.Paint(Read(data));

        /// <summary>The colour in the program's answer.</summary>
        protected abstract Color Read(TData data);
    }
}
