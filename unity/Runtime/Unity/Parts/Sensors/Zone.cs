using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>A trigger zone that a <see cref="ZoneSensor{TData}"/> detects.</summary>
    public readonly struct Zone
    {
        /// <summary>Creates a value.</summary>
        internal Zone(Collider collider, bool entered, bool left)
        {
            Collider = collider;
            Entered = entered;
            Left = left;
        }

        /// <summary>The zone's trigger collider. If it was destroyed, it compares equal to null, and the zone counts as left.</summary>
        public Collider Collider { get; }

        /// <summary>Whether the node entered since its last round.</summary>
        public bool Entered { get; }

        /// <summary>Whether the node left since its last round. Otherwise it is inside.</summary>
        public bool Left { get; }
    }
}
