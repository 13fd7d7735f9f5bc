using System.Collections;

namespace UnityEngine
{
    public class MonoBehaviour : Behaviour
    {
        internal readonly Messages messages;

        /// Sequence number of the last OnEnable among all components; 0 while the component is disabled. It determines the order of updates, and identifies
        /// stale list entries.
        internal int enabling;

        public MonoBehaviour() => messages = Messages.Of(GetType());

        internal bool HasAwoken, HasStarted;
        bool laysOutGui = true;

        // Has no effect: the stand-in's labels do not need a layout.
        public bool useGUILayout { get => this.Existing().laysOutGui; set => this.Existing().laysOutGui = value; }
        public bool didAwake => this.Existing().HasAwoken;
        public bool didStart => this.Existing().HasStarted;

        public static void print(object message) => Debug.Log(message);

        public Coroutine StartCoroutine(IEnumerator routine) => CoroutineScheduler.Start(this, routine);
        public void StopCoroutine(IEnumerator routine) => CoroutineScheduler.Stop(this.Existing(), routine);
        public void StopCoroutine(Coroutine routine) => CoroutineScheduler.Stop(this.Existing(), routine);
        public void StopAllCoroutines() => CoroutineScheduler.StopAll(this.Existing());

        internal override bool HasEnabled => enabling != 0;

        internal override void Activate()
        {
            if (!HasAwoken)
            {
                HasAwoken = true;
                if (!Messages.Send(messages.Awake, this)) ownEnabled = false; // as in Unity, a script whose Awake throws is disabled
            }
            Enable();
        }

        internal override void Deactivate()
        {
            Disable();
            CoroutineScheduler.StopAll(this);
        }

        internal override void EnabledChanged()
        {
            if (!HasAwoken) return;
            if (ownEnabled) Enable();
            else Disable();
        }

        void Enable()
        {
            if (HasEnabled || !ownEnabled || destroyed || !owner.activeInHierarchy) return;
            Lifecycle.Enabled(this);
            Messages.Send(messages.OnEnable, this);
        }

        /// Stops all messages to this script.
        internal void Silence()
        {
            HasAwoken = false;
            enabling = 0;
        }

        void Disable()
        {
            if (enabling == 0) return;
            enabling = 0;
            Messages.Send(messages.OnDisable, this);
        }
    }
}
