using System;
using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Selects the nodes whose bodies are inside this GameObject's trigger collider as neighbours. A node's trigger colliders are not part of its body. As
    /// for all triggers in Unity, this GameObject or the other node needs a Rigidbody. Use one trigger collider: with several, a body that leaves one of
    /// them no longer counts as inside.
    /// </summary>
    [AddComponentMenu("Collektive/Neighbourhoods/Trigger Neighbourhood")]
    public sealed class TriggerNeighbourhood : NeighbourhoodRule
    {
        private static readonly List<Collider> Found = new List<Collider>();

        private readonly GrowingArray<Visitor> visitors = new GrowingArray<Visitor>();

        // A trigger collider that was enabled in the last tick.
        private Collider trigger;

        private struct Visitor
        {
            internal Collider Collider;
            // Null for a collider without a node.
            internal Node Owner;
            // The owner's number of deactivations when the collider entered. Unity sends no exit message for them, but another enter message afterwards.
            internal int Deactivations;
            // The bodies of the collider and of the trigger when the collider entered.
            internal Rigidbody Body;
            internal Rigidbody OwnBody;
        }

        /// <inheritdoc/>
        protected override void OnDisable()
        {
            base.OnDisable();
            // Unity also sends trigger messages to disabled components, but not to inactive GameObjects.
            if (!gameObject.activeInHierarchy) visitors.Clear();
        }

        /// <inheritdoc/>
        protected override void FindNeighbours(NeighbourCollector neighbours)
        {
            // Unity sends no message when this object's own trigger is disabled.
            if (visitors.Count > 0 && !HasTrigger()) visitors.Clear();
            var all = visitors.Items;
            var here = Node.Position;
            var body = visitors.Count > 0 ? GetComponentInParent<Rigidbody>() : null;
            var remaining = 0;
            for (var i = 0; i < visitors.Count; i++)
            {
                ref var visitor = ref all[i];
                var owner = visitor.Owner;
                if (visitor.Collider.HasLeft(visitor.Body) || visitor.OwnBody != body) continue;
                if (!(owner is null) && visitor.Deactivations != owner.Deactivations) continue;
                // Unity sends no message when a collider gets another parent or node.
                if (owner == null || !owner.Owns(visitor.Collider)) owner = (visitor = VisitorOf(visitor.Collider)).Owner;
                if (remaining < i) all[remaining] = visitor;
                remaining++;
                if (owner is null) continue;
                // A node with several colliders in the zone is added only once.
                var offset = owner.Position;
                offset.x -= here.x;
                offset.y -= here.y;
                offset.z -= here.z;
                neighbours.Add(owner.Id, (float)Math.Sqrt(offset.x * offset.x + offset.y * offset.y + offset.z * offset.z), 0);
            }
            visitors.Truncate(remaining);
        }

        private void OnTriggerEnter(Collider other)
        {
            if (other.isTrigger) return;
            var index = Find(other);
            if (index == visitors.Count) visitors.Add(default);
            visitors.Items[index] = VisitorOf(other);
        }

        private Visitor VisitorOf(Collider collider)
        {
            var node = collider.GetComponentInParent<Node>();
            return new Visitor
            {
                Collider = collider, Owner = node, Deactivations = node == null ? 0 : node.Deactivations, Body = collider.attachedRigidbody,
                OwnBody = GetComponentInParent<Rigidbody>(),
            };
        }

        private void OnTriggerExit(Collider other)
        {
            var index = Find(other);
            if (index == visitors.Count) return;
            Array.Copy(visitors.Items, index + 1, visitors.Items, index, visitors.Count - index - 1);
            visitors.Truncate(visitors.Count - 1);
        }

        private bool HasTrigger()
        {
            if (IsOwnTrigger(trigger)) return true;
            GetComponentsInChildren(Found);
            trigger = null;
            for (var i = 0; i < Found.Count && trigger is null; i++)
            {
                if (IsOwnTrigger(Found[i])) trigger = Found[i];
            }
            Found.Clear();
            return !(trigger is null);
        }

        private bool IsOwnTrigger(Collider collider) => !collider.IsGone() && collider.isTrigger && Node.Owns(collider);

        private int Find(Collider collider)
        {
            var index = 0;
            while (index < visitors.Count && !ReferenceEquals(visitors.Items[index].Collider, collider)) index++;
            return index;
        }
    }
}
