using System;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Detects the colliders that touch the node's body or touched it since its last round, with point and impulse. Put it on the GameObject
    /// with the Rigidbody, which receives Unity's collision messages. Contacts of sleeping bodies keep their last point.
    /// </summary>
    /// <typeparam name="TData">As for <see cref="Sensor{TData}"/>.</typeparam>
    public abstract class ContactSensor<TData> : Sensor<TData>
    {
        private readonly GrowingArray<Contact> contacts = new GrowingArray<Contact>();
        // Parallel to the contacts: whether each ended since the last round.
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
            // Unity sends collision messages to disabled components too, but not to inactive GameObjects.
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

        /// <summary>Writes the contacts, the nearest to the node's centre first. The span is valid during the call only.</summary>
        protected abstract void Write(ref TData data, Span<Contact> contacts);

        /// <summary>Handles the start of a contact.</summary>
        protected virtual void OnCollisionEnter(Collision collision) => Touch(collision);

        /// <summary>Handles a continuing contact.</summary>
        protected virtual void OnCollisionStay(Collision collision) => Touch(collision);

        /// <summary>Handles the end of a contact.</summary>
        protected virtual void OnCollisionExit(Collision collision)
        {
            var place = Find(collision.collider);
            if (place < contacts.Count) ended.Items[place] = true;
        }

        private void Touch(Collision collision)
        {
            var count = collision.contactCount;
            if (count == 0) return;
            var normal = collision.GetContact(0).normal;
            var point = Vector3.zero;
            for (var i = 0; i < count; i++) point += collision.GetContact(i).point;
            var impulse = collision.impulse;
            // Unity gives both sides of a collision the same sign.
            if (Vector3.Dot(impulse, normal) < 0) impulse = -impulse;
            var place = Find(collision.collider);
            if (place == contacts.Count)
            {
                contacts.Add(default);
                ended.Add(false);
            }
            ended.Items[place] = false;
            contacts.Items[place] = new Contact(collision.collider, point / count, normal, contacts.Items[place].Impulse + impulse);
        }

        private int Find(Collider collider)
        {
            var place = 0;
            while (place < contacts.Count && !ReferenceEquals(contacts.Items[place].Collider, collider)) place++;
            return place;
        }

        private void RemoveStale()
        {
            var centre = Node.Position;
            var kept = 0;
            for (var i = 0; i < contacts.Count; i++)
            {
                var contact = contacts.Items[i];
                var hasEnded = ended.Items[i];
                if (contact.Collider.IsGone()) continue;
                var place = kept++;
                for (; place > 0 && ColliderExtensions.IsBefore(contact.Point - centre, contacts.Items[place - 1].Point - centre); place--)
                {
                    contacts.Items[place] = contacts.Items[place - 1];
                    ended.Items[place] = ended.Items[place - 1];
                }
                contacts.Items[place] = contact;
                ended.Items[place] = hasEnded;
            }
            contacts.Truncate(kept);
            ended.Truncate(kept);
        }

        private void BeginRound()
        {
            var kept = 0;
            for (var i = 0; i < contacts.Count; i++)
            {
                if (ended.Items[i]) continue;
                var contact = contacts.Items[i];
                contacts.Items[kept] = new Contact(contact.Collider, contact.Point, contact.Normal, Vector3.zero);
                ended.Items[kept++] = false;
            }
            contacts.Truncate(kept);
            ended.Truncate(kept);
        }
    }
}
