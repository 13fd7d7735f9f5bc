using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Sets the colour of the node's renderer to the program's answer.</summary>
    /// <typeparam name="TData">As for <see cref="Actuator{TData}"/>.</typeparam>
    public abstract class ColourActuator<TData> : Actuator<TData>, IColours
    {
        [SerializeField]
        [Tooltip("Renderer to colour. None: the first one on this GameObject or children without a Node.")]
        private Renderer target;

        /// <summary>
        /// The renderer to colour. If it is null when the component is enabled, the first renderer on this GameObject or children without a Node is
        /// selected.
        /// </summary>
        public Renderer Target
        {
            get => target;
            set => target = value;
        }

        /// <inheritdoc/>
        protected override void OnEnable()
        {
            base.OnEnable();
            if (target == null) target = Node.FindFirst<Renderer>(gameObject, Node);
            if (target != null) return;
            Debug.LogError(GetType().Name + " on '" + name + "' has no Renderer to colour: select one as Target, or add one to the GameObject", this);
            enabled = false;
        }

        /// <inheritdoc/>
        protected sealed override void Act(TData data) => target.Paint(Read(data));

        /// <summary>Returns the colour in the program's answer.</summary>
        protected abstract Color Read(TData data);
    }
}
