using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>A trigger zone, as a <see cref="ZoneSensor{TData}"/> perceives it.</summary>
    public readonly struct Zone
    {
        /// <summary>Makes one.</summary>
        internal Zone(Collider collider, bool entered, bool left)
        {
            Collider = collider;
            Entered = entered;
            Left = left;
        }

        /// <summary>The zone's trigger collider. One that was destroyed compares equal to null; the zone counts as left then.</summary>
        public Collider Collider { get; }

        /// <summary>Whether the node came in since its last round.</summary>
        public bool Entered { get; }

        /// <summary>Whether the node went out since its last round; it is inside otherwise.</summary>
        public bool Left { get; }
    }
}
