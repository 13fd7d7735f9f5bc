using System;

namespace UnityEngine
{
    /// Sends PhysX's reports to scripts. Enter is sent in the first step of a touch, Stay in later steps (for triggers also in the first step), and Exit in
    /// the first step without the touch. If a collider was disabled or destroyed in between, no Exit is sent. Messages of triggers precede those of collisions.
    sealed unsafe class Touches
    {
        struct Touch
        {
            public Collider A, B;
            public int RegistrationA, RegistrationB;
            public Physx.Phase Phase;
            public bool IsTrigger;
            public int FirstContact, ContactCount;
            public Vector3 RelativeVelocity; // of B as seen from A

            public readonly bool StillRegistered => A.Registered && B.Registered && A.Registration == RegistrationA && B.Registration == RegistrationB;
        }

        readonly Collision message = new Collision();
        Touch[] touches = new Touch[64];
        Physx.Contact[] contacts = new Physx.Contact[64];
        int count;

        public void Send(in Physx.Result result)
        {
            Copy(result);
            Orders.Shuffle(touches, count);
            if (Orders.IsPermuted) PutExitsFirst();
            // A message may change or destroy any object, but must not step physics.
            for (var index = 0; index < count; index++)
                if (touches[index].IsTrigger && touches[index].StillRegistered) SendTrigger(index);
            for (var index = 0; index < count; index++)
                if (!touches[index].IsTrigger && touches[index].StillRegistered) SendCollision(index);
            Clear();
        }

        void Copy(in Physx.Result result)
        {
            count = result.TouchCount;
            if (touches.Length < count) touches = new Touch[Mathf.NextPowerOfTwo(count)];
            if (contacts.Length < result.ContactCount) contacts = new Physx.Contact[Mathf.NextPowerOfTwo(result.ContactCount)];
            for (var index = 0; index < count; index++)
            {
                ref readonly var from = ref result.Touches[index];
                ref var touch = ref touches[index];
                touch.A = PhysicsWorld.ColliderOf(from.A);
                touch.B = PhysicsWorld.ColliderOf(from.B);
                touch.RegistrationA = touch.A.Registration;
                touch.RegistrationB = touch.B.Registration;
                touch.Phase = from.Phase;
                touch.IsTrigger = from.Trigger != 0;
                touch.FirstContact = from.FirstContact;
                touch.ContactCount = from.ContactCount;
                touch.RelativeVelocity = from.RelativeVelocity;
            }
            for (var index = 0; index < result.ContactCount; index++) contacts[index] = result.Contacts[index];
        }

        /// Moves the Exit of a pair before its Enter. A pair has both if a body becomes kinematic or dynamic inside a trigger.
        void PutExitsFirst()
        {
            for (var later = 0; later < count; later++)
                for (var index = 0; index < later && touches[later].Phase == Physx.Phase.Exit; index++)
                    if (touches[index].A == touches[later].A && touches[index].B == touches[later].B)
                        (touches[index], touches[later]) = (touches[later], touches[index]);
        }

        /// Releases the colliders.
        public void Clear()
        {
            Array.Clear(touches, 0, count);
            count = 0;
        }

        void SendTrigger(int index)
        {
            SendTrigger(index, touches[index].Phase);
            if (touches[index].Phase == Physx.Phase.Enter && touches[index].StillRegistered) SendTrigger(index, Physx.Phase.Stay);
        }

        void SendTrigger(int index, Physx.Phase phase)
        {
            Collider a = touches[index].A, b = touches[index].B;
            if (Orders.Swaps()) (a, b) = (b, a);
            SendTrigger(phase, a, b);
            if (touches[index].StillRegistered) SendTrigger(phase, b, a);
        }

        static void SendTrigger(Physx.Phase phase, Collider to, Collider other)
        {
            var body = to.Body;
            SendTrigger(phase, to.owner, other);
            if (!(body is null) && !ReferenceEquals(body.owner, to.owner)) SendTrigger(phase, body.owner, other);
        }

        static void SendTrigger(Physx.Phase phase, GameObject to, Collider other)
        {
            if ((to.touchMessages & (phase == Physx.Phase.Stay ? TouchMessages.TriggerStay : TouchMessages.TriggerChange)) == 0) return;
            for (var index = 0; index < to.components.Count && to.activeInHierarchy; index++)
            {
                if (!(to.components[index] is MonoBehaviour script) || !script.HasAwoken) continue;
                var messages = script.messages;
                Messages.Send(phase == Physx.Phase.Exit ? messages.OnTriggerExit : phase == Physx.Phase.Enter ? messages.OnTriggerEnter
                    : messages.OnTriggerStay, script, other);
            }
        }

        void SendCollision(int index)
        {
            var isSwapped = Orders.Swaps();
            if (isSwapped) SendCollision(index, touches[index].B, touches[index].A, -1f);
            if (touches[index].StillRegistered) SendCollision(index, touches[index].A, touches[index].B, 1f);
            if (!isSwapped && touches[index].StillRegistered) SendCollision(index, touches[index].B, touches[index].A, -1f);
        }

        void SendCollision(int touch, Collider to, Collider other, float sign)
        {
            var phase = touches[touch].Phase;
            var target = to.Body is null ? to.owner : to.Body.owner;
            if ((target.touchMessages & (phase == Physx.Phase.Stay ? TouchMessages.CollisionStay : TouchMessages.CollisionChange)) == 0) return;
            Fill(touches[touch], to, other, sign);
            for (var index = 0; index < target.components.Count && target.activeInHierarchy; index++)
            {
                if (!(target.components[index] is MonoBehaviour script) || !script.HasAwoken) continue;
                var messages = script.messages;
                Messages.Send(phase == Physx.Phase.Exit ? messages.OnCollisionExit : phase == Physx.Phase.Enter ? messages.OnCollisionEnter
                    : messages.OnCollisionStay, script, message);
            }
        }

        /// Fills the message with the touch, as seen from one of the two sides. The sign is 1 for side A. An Exit has no contacts.
        void Fill(in Touch touch, Collider to, Collider other, float sign)
        {
            message.collider = other;
            message.Contacts.Clear();
            message.impulse = Vector3.zero;
            message.relativeVelocity = touch.RelativeVelocity * sign;
            for (var index = touch.FirstContact; index < touch.FirstContact + touch.ContactCount; index++)
            {
                ref var contact = ref contacts[index];
                var impulse = contact.Impulse * sign;
                message.impulse += impulse;
                message.Contacts.Add(new ContactPoint
                {
                    point = contact.Point, normal = contact.Normal * sign, impulse = impulse, separation = contact.Separation, thisCollider = to,
                    otherCollider = other,
                });
            }
        }
    }
}
