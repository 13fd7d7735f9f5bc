using System;
using System.Collections.Generic;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Detects the trigger zones that the node is in, entered or left since its last round. A trigger zone is a trigger collider that belongs to no node.
    /// As for all triggers in Unity, the node or the zone needs a Rigidbody, and the sensor must be on the GameObject with the node's collider or body.
    /// The node's own trigger colliders, for example of a <see cref="TriggerNeighbourhood"/>, enter zones too: put them on a child whose layer does not
    /// collide with the layer of the zones.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class ZoneSensor<TData> : Sensor<TData>
    {
        private static readonly List<Collider> Found = new List<Collider>();

        private readonly GrowingArray<Visit> visits = new GrowingArray<Visit>();
        private Zone[] zones = Array.Empty<Zone>();

        [SerializeField]
        [Tooltip("Layers of the detected zones.")]
        private LayerMask layers = Physics.AllLayers;

        private struct Visit
        {
            internal Collider Zone;
            // A node with several colliders enters a zone several times.
            internal int Entries;
            // The physics step in which the last of the node's colliders left the zone; 0 outside of a simulation.
            internal ulong LeftIn;
            internal bool IsNew;
            // The bodies of the zone and of the node when the node entered.
            internal Rigidbody Body;
            internal Rigidbody OwnBody;

            internal bool IsValid(Rigidbody ownBody) => !Zone.HasLeft(Body) && ownBody == OwnBody;
        }

        /// <summary>Layers of the detected zones. A change applies to zones that are entered afterwards.</summary>
        public LayerMask Layers
        {
            get => layers;
            set => layers = value;
        }

        /// <summary>The current physics step; 0 outside of a simulation.</summary>
        private ulong Step => Node is null || Node.Simulation is null ? 0 : Node.Simulation.Context.Steps.Current;

        /// <inheritdoc/>
        protected override void OnDisable()
        {
            base.OnDisable();
            // Unity also sends trigger messages to disabled components, but not to inactive GameObjects.
            if (!gameObject.activeInHierarchy) visits.Clear();
        }

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data)
        {
            var count = visits.Count;
            SortNew();
            if (zones.Length < count) zones = new Zone[visits.Items.Length];
            var remaining = 0;
            var colliders = count > 0 ? CountColliders() : 0;
            var body = count > 0 ? GetComponentInParent<Rigidbody>() : null;
            for (var i = 0; i < count; i++)
            {
                var visit = visits.Items[i];
                // Unity sends no message when a collider of the node or the zone is disabled.
                visit.Entries = Math.Min(visit.Entries, colliders);
                var left = visit.Entries == 0 || !visit.IsValid(body);
                zones[i] = new Zone(visit.Zone, visit.IsNew, left);
                visit.IsNew = false;
                if (!left) visits.Items[remaining++] = visit;
            }
            visits.Truncate(remaining);
            Write(ref data, new Span<Zone>(zones, 0, count));
        }

        internal sealed override void NodeJoined()
        {
            var remaining = 0;
            for (var i = 0; i < visits.Count; i++)
            {
                var visit = visits.Items[i];
                visit.IsNew = true;
                if (visit.Entries > 0) visits.Items[remaining++] = visit;
            }
            visits.Truncate(remaining);
        }

        /// <summary>Writes the zones, sorted by the tick in which the node entered them and then by distance. The span is valid during the call only.</summary>
        protected abstract void Write(ref TData data, Span<Zone> zones);

        /// <summary>Handles a zone that the node enters.</summary>
        protected virtual void OnTriggerEnter(Collider other)
        {
            if (!other.isTrigger || (layers & 1 << other.gameObject.layer) == 0 || other.GetComponentInParent<Node>() != null) return;
            var index = Find(other);
            // A zone that was left since the last round is entered again, unless another collider of the node left it in this physics step.
            if (index < visits.Count && visits.Items[index].Entries == 0 && !IsCurrent(visits.Items[index].LeftIn))
            {
                Array.Copy(visits.Items, index + 1, visits.Items, index, visits.Count - index - 1);
                visits.Truncate(visits.Count - 1);
                index = visits.Count;
            }
            if (index == visits.Count) visits.Add(new Visit { Zone = other, IsNew = true });
            ref var visit = ref visits.Items[index];
            var body = GetComponentInParent<Rigidbody>();
            if (!visit.IsValid(body)) (visit.Entries, visit.Body, visit.OwnBody) = (0, other.attachedRigidbody, body);
            visit.Entries++;
            // A zone that was disabled and enabled is entered again without having been left.
            if (visit.Entries > 1) visit.Entries = Math.Min(visit.Entries, CountColliders());
        }

        /// <summary>Handles a zone that the node leaves.</summary>
        protected virtual void OnTriggerExit(Collider other)
        {
            var index = Find(other);
            if (index < visits.Count && visits.Items[index].Entries > 0 && --visits.Items[index].Entries == 0) visits.Items[index].LeftIn = Step;
        }

        private bool IsCurrent(ulong step) => step > 0 && step == Step;

        /// <summary>Sorts the new zones, which are at the end of the list, because Unity does not specify the order of trigger messages.</summary>
        private void SortNew()
        {
            var centre = Node.Position;
            for (var next = 1; next < visits.Count; next++)
            {
                var visit = visits.Items[next];
                if (!visit.IsNew || visit.Zone.IsGone()) continue;
                var offset = visit.Zone.transform.position - centre;
                var index = next;
                for (; index > 0 && visits.Items[index - 1].IsNew; index--)
                {
                    var other = visits.Items[index - 1].Zone;
                    if (!other.IsGone() && !ColliderExtensions.IsBefore(visit.Zone, offset, other, other.transform.position - centre)) break;
                    visits.Items[index] = visits.Items[index - 1];
                }
                visits.Items[index] = visit;
            }
        }

        /// <summary>Returns the number of enabled colliders of the node.</summary>
        private int CountColliders()
        {
            GetComponentsInChildren(Found);
            Found.RemoveAll(collider => collider.IsGone());
            var count = Found.Count;
            Found.Clear();
            return count;
        }

        private int Find(Collider zone)
        {
            var index = 0;
            while (index < visits.Count && !ReferenceEquals(visits.Items[index].Zone, zone)) index++;
            return index;
        }
    }
}
