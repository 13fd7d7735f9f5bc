using System;
using Collektive.Bridge;
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
        private readonly GrowingArray<Visitor> visitors = new GrowingArray<Visitor>();

        private struct Visitor
        {
            internal Collider Collider;
            internal Node Owner;
        }

        /// <inheritdoc/>
        protected override void OnDisable()
        {
            base.OnDisable();
            // Unity sends trigger messages to disabled components too, but not to inactive GameObjects.
            if (!gameObject.activeInHierarchy) visitors.Clear();
        }

        /// <inheritdoc/>
        protected override void FindNeighbours(NeighbourCollector neighbours)
        {
            var all = visitors.Items;
            var here = Node.Position;
            var kept = 0;
            for (var i = 0; i < visitors.Count; i++)
            {
                ref var visitor = ref all[i];
                if (visitor.Collider.IsGone()) continue;
                // A node with several colliders in the zone counts once.
                var owner = visitor.Owner;
                var way = owner.Position;
                way.x -= here.x;
                way.y -= here.y;
                way.z -= here.z;
                neighbours.Add(owner.Id, (float)Math.Sqrt(way.x * way.x + way.y * way.y + way.z * way.z), 0);
                if (kept < i) all[kept] = visitor;
                kept++;
            }
            visitors.Truncate(kept);
        }

        private void OnTriggerEnter(Collider other)
        {
            if (other.isTrigger || Find(other) < visitors.Count) return;
            var node = other.GetComponentInParent<Node>();
            if (node != null) visitors.Add(new Visitor { Collider = other, Owner = node });
        }

        private void OnTriggerExit(Collider other)
        {
            var place = Find(other);
            if (place == visitors.Count) return;
            Array.Copy(visitors.Items, place + 1, visitors.Items, place, visitors.Count - place - 1);
            visitors.Truncate(visitors.Count - 1);
        }

        private int Find(Collider collider)
        {
            var place = 0;
            while (place < visitors.Count && !ReferenceEquals(visitors.Items[place].Collider, collider)) place++;
            return place;
        }
    }
}
