namespace UnityEngine
{
    public class Behaviour : Component
    {
        internal bool ownEnabled = true;

        public bool enabled
        {
            get
            {
                ThrowIfDestroyed();
                return ownEnabled;
            }
            set
            {
                ThrowIfDestroyed();
                if (ownEnabled == value) return;
                ownEnabled = value;
                EnabledChanged();
            }
        }

        public bool isActiveAndEnabled => enabled && owner.activeInHierarchy && HasEnabled;

        /// Whether OnEnable was called.
        internal virtual bool HasEnabled => true;

        internal virtual void EnabledChanged() { }
    }
}
