namespace UnityEngine
{
    public class Behaviour : Component
    {
        internal bool ownEnabled = true;

        public bool enabled
        {
            get => ownEnabled;
            set
            {
                ThrowIfDestroyed();
                if (ownEnabled == value) return;
                ownEnabled = value;
                EnabledChanged();
            }
        }

        public bool isActiveAndEnabled => !destroyed && ownEnabled && owner.activeInHierarchy;

        internal virtual void EnabledChanged() { }
    }
}
