using System.Collections.Generic;

namespace UnityEngine
{
    public struct ContactPoint
    {
        public Vector3 point { get; internal set; }
        /// The normal. It points from the other collider to this one.
        public Vector3 normal { get; internal set; }
        public Vector3 impulse { get; internal set; }
        public Collider thisCollider { get; internal set; }
        public Collider otherCollider { get; internal set; }
        public float separation { get; internal set; }
    }

    /// The data of a collision message. As in Unity by default, one instance is reused for all messages, so copy the values that you want to keep.
    public class Collision
    {
        internal readonly List<ContactPoint> Contacts = new List<ContactPoint>();

        public Vector3 impulse { get; internal set; }
        public Vector3 relativeVelocity { get; internal set; }
        public Collider collider { get; internal set; }
        public Rigidbody rigidbody => collider.attachedRigidbody;
        public Component body => rigidbody;
        public Transform transform => rigidbody ? rigidbody.transform : collider.transform;
        public GameObject gameObject => transform.gameObject;
        public int contactCount => Contacts.Count;
        public ContactPoint[] contacts => Contacts.ToArray();
        public ContactPoint GetContact(int index) => Contacts[index];

        public int GetContacts(ContactPoint[] contacts)
        {
            var count = Mathf.Min(contacts.Length, Contacts.Count);
            Contacts.CopyTo(0, contacts, 0, count);
            return count;
        }

        public int GetContacts(List<ContactPoint> contacts)
        {
            contacts.Clear();
            contacts.AddRange(Contacts);
            return contacts.Count;
        }
    }
}
