using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Neighbours are the nodes whose bodies are inside this GameObject's trigger collider. Trigger colliders of other nodes do not
    /// count as their bodies. As everywhere in Unity, one of the two sides needs a Rigidbody.
    /// </summary>
    [AddComponentMenu("Collektive/Neighbourhoods/Trigger Neighbourhood")]
    public sealed class TriggerNeighbourhood : NeighbourhoodRule
    {
        private readonly List<Collider> inside = new List<Collider>();
        private readonly List<Node> owners = new List<Node>();

        /// <inheritdoc/>
        protected override void OnDisable()
        {
            base.OnDisable();
            // A component that is disabled by itself goes on hearing of entries and exits; an inactive GameObject does not.
            if (gameObject.activeInHierarchy) return;
            inside.Clear();
            owners.Clear();
        }

        /// <inheritdoc/>
        protected override void FindNeighbours(SimulationManager manager)
        {
            for (var i = inside.Count - 1; i >= 0; i--)
            {
                if (inside[i].IsGone()) Remove(i);
            }
            for (var i = 0; i < owners.Count; i++)
            {
                // A node with several colliders in the zone counts once.
                if (owners.IndexOf(owners[i]) == i) Connect(owners[i]);
            }
        }

        private void OnTriggerEnter(Collider other)
        {
            if (other.isTrigger || inside.Contains(other)) return;
            var node = other.GetComponentInParent<Node>();
            if (node == null) return;
            inside.Add(other);
            owners.Add(node);
        }

        private void OnTriggerExit(Collider other)
        {
            var index = inside.IndexOf(other);
            if (index >= 0) Remove(index);
        }

        private void Remove(int index)
        {
            inside.RemoveAt(index);
            owners.RemoveAt(index);
        }
    }
}
