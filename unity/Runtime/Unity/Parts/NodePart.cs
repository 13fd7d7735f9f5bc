using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// A component that belongs to the <see cref="Collektive.Unity.Node"/> on its GameObject or on the nearest parent. A subclass that needs
    /// <c>OnEnable</c>, <c>OnDisable</c> or another message method of its base class must override the method and call the base method.
    /// </summary>
    [HelpPage("sensors-and-actuators.md#ready-made-components")]
    public abstract class NodePart : MonoBehaviour
    {
        internal const int MaxFailuresInRow = 10;

        private int failuresInRow;

        /// <summary>The node that this component belongs to; null until it is enabled.</summary>
        public Node Node { get; private set; }

        /// <summary>Whether the part is in the node's list.</summary>
        internal bool IsAttached { get; private set; }

        /// <summary>The list of batched parts that the part is in; null if it is in none.</summary>
        internal BatchedParts BatchedIn { get; set; }

        /// <summary>The number of the last batch that contained the part's queries; 0 before the first one.</summary>
        internal ulong BatchedAt { get; set; }

        /// <summary>Joins the node.</summary>
        protected virtual void OnEnable() => Attach();

        /// <summary>Leaves the node.</summary>
        protected virtual void OnDisable() => Detach();

        /// <summary>Joins another node if the new parents belong to it.</summary>
        protected virtual void OnTransformParentChanged()
        {
            UpdateNode();
            if (IsAttached) Reparented();
        }

        /// <summary>Joins the nearest node if the part belongs to another one.</summary>
        internal void UpdateNode()
        {
            if (!IsAttached || ReferenceEquals(GetComponentInParent<Node>(), Node)) return;
            Detach();
            Attach();
        }

        /// <summary>Joins <paramref name="to"/> if the part belongs to <paramref name="from"/>.</summary>
        internal void Move(Node from, Node to)
        {
            if (!IsAttached || !ReferenceEquals(from, Node)) return;
            Detach();
            Join(to);
        }

        /// <summary>Returns the Rigidbody on this GameObject or the nearest parent, or null if that one belongs to another node.</summary>
        internal Rigidbody FindBody()
        {
            var body = GetComponentInParent<Rigidbody>();
            var owner = body == null ? null : body.GetComponentInParent<Node>();
            return owner == null || owner == Node ? body : null;
        }

        /// <summary>Throws an exception if a setting is negative or not a number.</summary>
        internal static void CheckNotNegative(string name, float value)
        {
            if (!(value >= 0)) throw new InvalidOperationException("its " + name + " is " + value + ": set it to 0 or greater");
        }

        internal void Succeeded()
        {
            // The count is nearly always 0 already. Checking it avoids a write, which would dirty a cache line in each call.
            if (failuresInRow != 0) failuresInRow = 0;
        }

        /// <summary>Counts a failure.</summary>
        /// <returns>Whether the component failed too often in a row and must be disabled.</returns>
        internal bool HasFailedTooOften()
        {
            if (++failuresInRow < MaxFailuresInRow) return false;
            failuresInRow = 0;
            return true;
        }

        /// <summary>Returns the list of a node that contains this part while the part is enabled.</summary>
        internal abstract ref PartList ListOf(Node node);

        /// <summary>Does the part's work in a tick.</summary>
        /// <param name="tick">The tick of the node's simulation.</param>
        /// <param name="index">The index of the node's data in the buffer of this tick.</param>
        internal abstract void Run(TickContext tick, int index);

        /// <summary>Adds the part's physics queries to the batches of the tick. Called before <see cref="Run"/> if <see cref="BatchedIn"/> is set.</summary>
        internal virtual void Enqueue(TickContext tick)
        {
        }

        /// <summary>Reads the data of the tick that a ready-made part needs. <see cref="Run"/> calls it before the method that users override.</summary>
        internal virtual void Prepare(TickContext tick)
        {
        }

        /// <summary>Stops a simulation whose schema differs from the schema of this sensor or actuator.</summary>
        internal void FailWithSchemaMismatch(TickContext tick, string kind, Type actual, Type expected)
        {
            tick.Fail(kind + " " + GetType().Name + " of node " + Node.Id + " ('" + Node.name + "') is written for " + actual.FullName
                + ", but the session's schema has " + expected.FullName + ": use a component for this schema, or select the component's schema", this);
        }

        /// <summary>Called after the part was added to the node's list.</summary>
        internal virtual void Attached()
        {
        }

        /// <summary>Called after a direct or indirect parent of an attached part has changed.</summary>
        internal virtual void Reparented()
        {
        }

        /// <summary>Called after the node of an attached sensor joined a simulation.</summary>
        internal virtual void NodeJoined()
        {
        }

        /// <summary>Called after the part was removed from the node's list.</summary>
        internal virtual void Detached()
        {
        }

        private void Attach()
        {
            Node = GetComponentInParent<Node>();
            if (Node == null)
            {
                Debug.LogError(
                    GetType().Name + " on '" + name + "' has no Node on its GameObject or its parents: add the component Collektive/Node", this);
                enabled = false;
            }
            else Join(Node);
        }

        private void Join(Node node)
        {
            Node = node;
            ListOf(node).Add(this);
            IsAttached = true;
            Attached();
        }

        private void Detach()
        {
            if (!IsAttached) return;
            ListOf(Node).Remove(this);
            IsAttached = false;
            // The queries of this tick's batch have the position of this node.
            BatchedAt = 0;
            Detached();
        }
    }
}
