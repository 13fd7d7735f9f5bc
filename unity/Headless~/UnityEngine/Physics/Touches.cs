using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace UnityEngine
{
    /// Pairs of colliders that touch and that somebody listens to: Enter in the first step, Stay in each later one, Exit in the first without.
    /// A collider that was disabled or destroyed in between gives no Exit, as in Unity.
    sealed unsafe class Touches
    {
        public sealed class Touch
        {
            public Collider A, B;
            public ulong Key;
            public int RegistrationA, RegistrationB;
            public bool IsTrigger;
            public int FirstStep, LastStep;
            public int FirstContact, ContactCount;
            public Vector3 RelativeVelocity; // of B as seen from A

            public bool StillRegistered => A.Registered && B.Registered && A.Registration == RegistrationA && B.Registration == RegistrationB;
        }

        struct Contact
        {
            public Vector3 Point, Normal;
            public float Depth;
        }

        readonly Dictionary<ulong, Touch> byPair = new Dictionary<ulong, Touch>();
        readonly List<Touch> ordered = new List<Touch>();
        readonly Stack<Touch> spare = new Stack<Touch>();
        readonly Collision message = new Collision();
        Contact[] contacts = new Contact[64];
        IntPtr[] feedback = new IntPtr[0]; // one JointFeedback per contact: joints keep the address, so they never move
        int contactCount, step;

        public void BeginStep()
        {
            step++;
            contactCount = 0;
        }

        public void AddTrigger(Collider a, Collider b) => Add(a, b, true);

        public Touch AddCollision(Collider a, Collider b)
        {
            var touch = Add(a, b, false);
            touch.FirstContact = contactCount;
            touch.ContactCount = 0;
            touch.RelativeVelocity = VelocityOf(touch.B) - VelocityOf(touch.A);
            return touch;
        }

        static Vector3 VelocityOf(Collider collider) => collider.IsStatic ? Vector3.zero : collider.Body.linearVelocity;

        Touch Add(Collider a, Collider b, bool isTrigger)
        {
            var key = IgnoredPairs.Key(a, b);
            if (byPair.TryGetValue(key, out var touch) && (!touch.StillRegistered || touch.IsTrigger != isTrigger))
            {
                touch.LastStep = 0; // another touch of the same pair begins; the old one ends without Exit
                touch.Key = 0;
                byPair.Remove(key);
                touch = null;
            }
            if (touch == null)
            {
                touch = spare.Count > 0 ? spare.Pop() : new Touch();
                touch.A = a;
                touch.B = b;
                touch.Key = key;
                touch.RegistrationA = a.Registration;
                touch.RegistrationB = b.Registration;
                touch.IsTrigger = isTrigger;
                touch.FirstStep = step;
                byPair.Add(key, touch);
                ordered.Add(touch);
            }
            touch.LastStep = step;
            return touch;
        }

        /// Notes a contact of the touch; returns where ODE shall put its forces.
        public Ode.JointFeedback* AddContact(Touch touch, Ode.ContactGeometry* geometry)
        {
            if (contactCount == contacts.Length) Array.Resize(ref contacts, 2 * contactCount);
            if (contactCount == feedback.Length) GrowFeedback();
            var flip = touch.A.Geom == geometry->geom1 ? 1f : -1f;
            contacts[contactCount] = new Contact
            {
                Point = new Vector3((float)geometry->position[0], (float)geometry->position[1], (float)geometry->position[2]),
                Normal = new Vector3((float)geometry->normal[0], (float)geometry->normal[1], (float)geometry->normal[2]) * flip,
                Depth = (float)geometry->depth,
            };
            touch.ContactCount++;
            return (Ode.JointFeedback*)feedback[contactCount++];
        }

        void GrowFeedback()
        {
            var known = feedback.Length;
            Array.Resize(ref feedback, Math.Max(64, 2 * known));
            var block = (Ode.JointFeedback*)Marshal.AllocHGlobal((feedback.Length - known) * sizeof(Ode.JointFeedback));
            for (var index = known; index < feedback.Length; index++) feedback[index] = (IntPtr)block++;
        }

        public void SendMessages(float duration)
        {
            // By index: a message may do anything but step.
            for (var index = 0; index < ordered.Count; index++)
            {
                var touch = ordered[index];
                if (!touch.StillRegistered || touch.Key == 0) continue;
                if (touch.IsTrigger) SendTrigger(touch);
                else SendCollision(touch, duration);
            }
            var kept = 0;
            for (var index = 0; index < ordered.Count; index++)
            {
                var touch = ordered[index];
                if (touch.LastStep == step && touch.StillRegistered) ordered[kept++] = touch;
                else Forget(touch);
            }
            ordered.RemoveRange(kept, ordered.Count - kept);
        }

        bool IsStay(Touch touch) => touch.FirstStep != step && touch.LastStep == step;

        void Forget(Touch touch)
        {
            if (touch.Key != 0) byPair.Remove(touch.Key);
            touch.A = touch.B = null;
            spare.Push(touch);
        }

        void SendTrigger(Touch touch)
        {
            SendTrigger(touch, touch.A, touch.B);
            if (touch.StillRegistered) SendTrigger(touch, touch.B, touch.A);
        }

        void SendTrigger(Touch touch, Collider to, Collider other)
        {
            var body = to.Body;
            SendTrigger(touch, to.owner, other);
            if (!(body is null) && !ReferenceEquals(body.owner, to.owner)) SendTrigger(touch, body.owner, other);
        }

        void SendTrigger(Touch touch, GameObject to, Collider other)
        {
            if ((to.hears & (IsStay(touch) ? TouchMessages.TriggerStay : TouchMessages.TriggerChange)) == 0) return;
            for (var index = 0; index < to.components.Count && to.activeInHierarchy; index++)
            {
                if (!(to.components[index] is MonoBehaviour script) || !script.didAwake) continue;
                var messages = script.messages;
                Messages.Send(touch.LastStep != step ? messages.OnTriggerExit : touch.FirstStep == step ? messages.OnTriggerEnter : messages.OnTriggerStay,
                    script, other);
            }
        }

        void SendCollision(Touch touch, float duration)
        {
            SendCollision(touch, touch.A, touch.B, 1f, duration);
            if (touch.StillRegistered) SendCollision(touch, touch.B, touch.A, -1f, duration);
        }

        void SendCollision(Touch touch, Collider to, Collider other, float sign, float duration)
        {
            var target = to.IsStatic ? to.owner : to.Body.owner;
            if ((target.hears & (IsStay(touch) ? TouchMessages.CollisionStay : TouchMessages.CollisionChange)) == 0) return;
            Fill(touch, to, other, sign, duration);
            for (var index = 0; index < target.components.Count && target.activeInHierarchy; index++)
            {
                if (!(target.components[index] is MonoBehaviour script) || !script.didAwake) continue;
                var messages = script.messages;
                Messages.Send(touch.LastStep != step ? messages.OnCollisionExit : touch.FirstStep == step ? messages.OnCollisionEnter
                    : messages.OnCollisionStay, script, message);
            }
        }

        /// The touch as seen from one side; sign is 1 for A.
        void Fill(Touch touch, Collider to, Collider other, float sign, float duration)
        {
            message.collider = other;
            message.Contacts.Clear();
            message.impulse = message.relativeVelocity = Vector3.zero;
            if (touch.LastStep != step) return; // an Exit carries no contacts
            message.relativeVelocity = touch.RelativeVelocity * sign;
            for (var index = touch.FirstContact; index < touch.FirstContact + touch.ContactCount; index++)
            {
                var contact = contacts[index];
                // ODE gives the force on the joint's first body, which is B when A has none.
                var force = ((Ode.JointFeedback*)feedback[index])->force1;
                var impulse = new Vector3((float)force[0], (float)force[1], (float)force[2]) * (duration * (touch.A.IsStatic ? -sign : sign));
                message.impulse += impulse;
                message.Contacts.Add(new ContactPoint
                {
                    point = contact.Point, normal = contact.Normal * sign, impulse = impulse, separation = -contact.Depth, thisCollider = to,
                    otherCollider = other,
                });
            }
        }

        public void Clear()
        {
            byPair.Clear();
            ordered.Clear();
            contactCount = 0;
        }
    }
}
