using System;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Detects the colliders that touch the node's body, or touched it since the node's last round, with the contact point and the impulse. The component
    /// must be on the GameObject with the Rigidbody, because Unity sends collision messages to that object. While a body sleeps, its contacts keep their
    /// last point.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class ContactSensor<TData> : Sensor<TData>
    {
        // The contacts of each collider of the node. Those with the same other collider are merged in each round.
        private readonly GrowingArray<Contact> contacts = new GrowingArray<Contact>();
        // For each contact, whether it ended since the last round.
        private readonly GrowingArray<bool> ended = new GrowingArray<bool>();

        /// <inheritdoc/>
        protected override void OnEnable()
        {
            base.OnEnable();
            BeginRound();
        }

        /// <inheritdoc/>
        protected override void OnDisable()
        {
            base.OnDisable();
            // Unity also sends collision messages to disabled components, but not to inactive GameObjects.
            if (gameObject.activeInHierarchy) return;
            contacts.Clear();
            ended.Clear();
        }

        /// <inheritdoc/>
        protected sealed override void Sense(ref TData data)
        {
            RemoveStale();
            Write(ref data, new Span<Contact>(contacts.Items, 0, contacts.Count));
            BeginRound();
        }

        internal sealed override void NodeJoined() => BeginRound();

        /// <summary>Writes the contacts, the nearest to the node's centre first. The span is valid during the call only.</summary>
        protected abstract void Write(ref TData data, Span<Contact> contacts);

        /// <summary>Handles the start of a contact.</summary>
        protected virtual void OnCollisionEnter(Collision collision) => Touch(collision);

        /// <summary>Handles a continuing contact.</summary>
        protected virtual void OnCollisionStay(Collision collision) => Touch(collision);

        /// <summary>Handles the end of a contact.</summary>
        protected virtual void OnCollisionExit(Collision collision)
        {
            // Unity does not report which of the node's colliders no longer touches it. The others are reported again in the next step.
            for (var i = 0; i < contacts.Count; i++) ended.Items[i] |= ReferenceEquals(contacts.Items[i].Collider, collision.collider);
        }

        private void Touch(Collision collision)
        {
            var count = collision.contactCount;
            if (count == 0) return;
            var first = collision.GetContact(0);
            var point = Vector3.zero;
            var normal = first.normal;
            var impulse = Vector3.zero;
            var greatest = 0f;
            for (var i = 0; i < count; i++)
            {
                var contact = collision.GetContact(i);
                point += contact.point;
                // Unity reports impulses with the same sign to both sides of a collision. The sign of their sum is not enough, because the normals of a mesh
                // can be opposed.
                impulse += Vector3.Dot(contact.impulse, contact.normal) < 0 ? -contact.impulse : contact.impulse;
                if (contact.impulse.sqrMagnitude <= greatest) continue;
                greatest = contact.impulse.sqrMagnitude;
                normal = contact.normal;
            }
            var index = 0;
            while (index < contacts.Count && !contacts.Items[index].IsOf(first.thisCollider, collision.collider)) index++;
            if (index == contacts.Count)
            {
                contacts.Add(default);
                ended.Add(false);
            }
            ended.Items[index] = false;
            impulse += contacts.Items[index].Impulse;
            contacts.Items[index] = new Contact(first.thisCollider, collision.collider, collision.rigidbody, point / count, normal, impulse);
        }

        private void RemoveStale()
        {
            var centre = Node.Position;
            var remaining = 0;
            for (var i = 0; i < contacts.Count; i++)
            {
                var contact = contacts.Items[i];
                var hasEnded = ended.Items[i];
                // The body also reports the contacts of nodes on its children.
                if (contact.HasEnded || !Node.Owns(contact.Own)) continue;
                var index = remaining++;
                for (; index > 0; index--)
                {
                    ref var other = ref contacts.Items[index - 1];
                    if (!ColliderExtensions.IsBefore(contact.Collider, contact.Point - centre, other.Collider, other.Point - centre)) break;
                    contacts.Items[index] = other;
                    ended.Items[index] = ended.Items[index - 1];
                }
                contacts.Items[index] = contact;
                ended.Items[index] = hasEnded;
            }
            contacts.Truncate(remaining);
            ended.Truncate(remaining);
            if (remaining > 1) Merge();
        }

        /// <summary>Adds the impulses of contacts with the same other collider to the nearest of them.</summary>
        private void Merge()
        {
            var remaining = 0;
            for (var i = 0; i < contacts.Count; i++)
            {
                var contact = contacts.Items[i];
                var index = 0;
                while (index < remaining && !ReferenceEquals(contacts.Items[index].Collider, contact.Collider)) index++;
                var isFirst = index == remaining;
                if (isFirst) remaining++;
                contacts.Items[index] = isFirst ? contact : contacts.Items[index].WithImpulse(contacts.Items[index].Impulse + contact.Impulse);
                ended.Items[index] = ended.Items[i] && (isFirst || ended.Items[index]);
            }
            contacts.Truncate(remaining);
            ended.Truncate(remaining);
        }

        private void BeginRound()
        {
            var remaining = 0;
            for (var i = 0; i < contacts.Count; i++)
            {
                if (ended.Items[i]) continue;
                var contact = contacts.Items[i];
                contacts.Items[remaining] = contact.WithImpulse(Vector3.zero);
                ended.Items[remaining++] = false;
            }
            contacts.Truncate(remaining);
            ended.Truncate(remaining);
        }
    }
}
