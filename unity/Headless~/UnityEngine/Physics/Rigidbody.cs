using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public enum ForceMode
    {
        Force = 0,
        Acceleration = 5,
        Impulse = 1,
        VelocityChange = 2,
    }

    [Flags]
    public enum RigidbodyConstraints
    {
        None = 0,
        FreezePositionX = 1 << 1,
        FreezePositionY = 1 << 2,
        FreezePositionZ = 1 << 3,
        FreezeRotationX = 1 << 4,
        FreezeRotationY = 1 << 5,
        FreezeRotationZ = 1 << 6,
        FreezePosition = FreezePositionX | FreezePositionY | FreezePositionZ,
        FreezeRotation = FreezeRotationX | FreezeRotationY | FreezeRotationZ,
        FreezeAll = FreezePosition | FreezeRotation,
    }

    public enum RigidbodyInterpolation
    {
        None = 0,
        Interpolate = 1,
        Extrapolate = 2,
    }

    public enum CollisionDetectionMode
    {
        Discrete = 0,
        Continuous = 1,
        ContinuousDynamic = 2,
        ContinuousSpeculative = 3,
    }

    /// Bodies sleep only when told to. Detection is discrete whatever the mode, and nothing is interpolated: no frame lies between steps.
    [DisallowMultipleComponent]
    public class Rigidbody : Component
    {
        internal readonly List<Collider> Colliders = new List<Collider>();
        internal Vector3 PosePosition;
        internal Quaternion PoseRotation = Quaternion.identity;
        internal Vector3 CenterOfMass;
        internal bool MassStale = true;

        OdeBody ode;
        float ownMass = 1f;
        bool kinematic;
        RigidbodyConstraints ownConstraints;
        Vector3 velocity, spin;
        Vector3 accelerationDue, velocityDue, torqueDue, angularImpulseDue, angularAccelerationDue, spinDue;
        Vector3 targetPosition;
        Quaternion targetRotation;
        bool hasTarget, poseUnpublished;

        public bool useGravity { get; set; } = true;
        public float linearDamping { get; set; }
        public float angularDamping { get; set; } = 0.05f;
        public float maxLinearVelocity { get; set; } = 1e16f;
        public float maxAngularVelocity { get; set; } = 7f;
        public CollisionDetectionMode collisionDetectionMode { get; set; }
        public RigidbodyInterpolation interpolation { get; set; }

        internal bool Registered => ode != null;
        internal IntPtr Handle => ode.Handle;

        public float mass
        {
            get => ownMass;
            set
            {
                ownMass = Mathf.Max(value, 1e-7f);
                MassStale = true;
            }
        }

        public bool isKinematic
        {
            get => kinematic;
            set
            {
                if (kinematic == value) return;
                kinematic = value;
                velocity = spin = Vector3.zero;
                ClearForces();
                MassStale = true;
            }
        }

        public RigidbodyConstraints constraints
        {
            get => ownConstraints;
            set
            {
                ownConstraints = value;
                MassStale = true;
            }
        }

        public bool freezeRotation
        {
            get => (ownConstraints & RigidbodyConstraints.FreezeRotation) == RigidbodyConstraints.FreezeRotation;
            set => constraints = value ? ownConstraints | RigidbodyConstraints.FreezeRotation : ownConstraints & ~RigidbodyConstraints.FreezeRotation;
        }

        bool TakesVelocity(string kind)
        {
            if (isKinematic) Debug.LogWarning($"Setting {kind} velocity of a kinematic body is not supported.", this);
            return !isKinematic;
        }

        public Vector3 linearVelocity
        {
            get => velocity;
            set
            {
                if (!Finite.Accepts(value, "Rigidbody.linearVelocity", this) || !TakesVelocity("linear")) return;
                velocity = value;
                if (!value.Equals(Vector3.zero)) WakeUp();
            }
        }

        public Vector3 angularVelocity
        {
            get => spin;
            set
            {
                if (!Finite.Accepts(value, "Rigidbody.angularVelocity", this) || !TakesVelocity("angular")) return;
                spin = value;
                if (!value.Equals(Vector3.zero)) WakeUp();
            }
        }

        /// Where physics has the body; setting it moves the transform with the next step.
        public Vector3 position
        {
            get => Registered ? PosePosition : transform.position;
            set => Teleport(value, rotation);
        }

        public Quaternion rotation
        {
            get => Registered ? PoseRotation : transform.rotation;
            set => Teleport(position, value.normalized);
        }

        public Vector3 worldCenterOfMass
        {
            get
            {
                if (MassStale && Registered) RefreshMass();
                return position + rotation * CenterOfMass;
            }
        }

        // ---- Control --------------------------------------------------------------------------------------------------

        /// A kinematic body gets there with the next step, pushing what is in its way; another one is put there.
        public void MovePosition(Vector3 position) => Move(position, hasTarget ? targetRotation : rotation);

        public void MoveRotation(Quaternion rotation) => Move(hasTarget ? targetPosition : position, rotation);

        public void Move(Vector3 position, Quaternion rotation)
        {
            if (!Finite.Accepts(position, "Rigidbody.MovePosition", this) || !Finite.Accepts(rotation, "Rigidbody.MoveRotation", this)) return;
            targetPosition = position;
            targetRotation = rotation.normalized;
            hasTarget = true;
        }

        public void AddForce(Vector3 force) => AddForce(force, ForceMode.Force);
        public void AddForce(float x, float y, float z) => AddForce(new Vector3(x, y, z));
        public void AddForce(float x, float y, float z, ForceMode mode) => AddForce(new Vector3(x, y, z), mode);

        /// Takes effect with the next step.
        public void AddForce(Vector3 force, ForceMode mode)
        {
            if (!Finite.Accepts(force, "Rigidbody.AddForce", this)) return;
            switch (mode)
            {
                case ForceMode.Force: accelerationDue += force / ownMass; break;
                case ForceMode.Acceleration: accelerationDue += force; break;
                case ForceMode.Impulse: velocityDue += force / ownMass; break;
                case ForceMode.VelocityChange: velocityDue += force; break;
            }
            WakeUp();
        }

        public void AddRelativeForce(Vector3 force) => AddRelativeForce(force, ForceMode.Force);
        public void AddRelativeForce(Vector3 force, ForceMode mode) => AddForce(rotation * force, mode);

        public void AddTorque(Vector3 torque) => AddTorque(torque, ForceMode.Force);
        public void AddTorque(float x, float y, float z) => AddTorque(new Vector3(x, y, z));
        public void AddTorque(float x, float y, float z, ForceMode mode) => AddTorque(new Vector3(x, y, z), mode);

        public void AddTorque(Vector3 torque, ForceMode mode)
        {
            if (!Finite.Accepts(torque, "Rigidbody.AddTorque", this)) return;
            switch (mode)
            {
                case ForceMode.Force: torqueDue += torque; break;
                case ForceMode.Acceleration: angularAccelerationDue += torque; break;
                case ForceMode.Impulse: angularImpulseDue += torque; break;
                case ForceMode.VelocityChange: spinDue += torque; break;
            }
            WakeUp();
        }

        public void AddRelativeTorque(Vector3 torque) => AddRelativeTorque(torque, ForceMode.Force);
        public void AddRelativeTorque(Vector3 torque, ForceMode mode) => AddTorque(rotation * torque, mode);

        public void AddForceAtPosition(Vector3 force, Vector3 position) => AddForceAtPosition(force, position, ForceMode.Force);

        /// For `Force` and `Impulse`, the modes that Unity supports here.
        public void AddForceAtPosition(Vector3 force, Vector3 position, ForceMode mode)
        {
            AddForce(force, mode);
            AddTorque(Vector3.Cross(position - worldCenterOfMass, force), mode);
        }

        public Vector3 GetPointVelocity(Vector3 worldPoint) => velocity + Vector3.Cross(spin, worldPoint - worldCenterOfMass);

        public void Sleep()
        {
            velocity = spin = Vector3.zero;
            ClearForces();
            ode?.SetEnabled(false);
        }

        public void WakeUp() => ode?.SetEnabled(true);
        public bool IsSleeping() => ode != null && !ode.Enabled;

        void ClearForces() =>
            accelerationDue = velocityDue = torqueDue = angularImpulseDue = angularAccelerationDue = spinDue = Vector3.zero;

        void Teleport(Vector3 position, Quaternion rotation)
        {
            if (!Finite.Accepts(position, "Rigidbody.position", this) || !Finite.Accepts(rotation, "Rigidbody.rotation", this)) return;
            if (!Registered)
            {
                transform.SetPositionAndRotation(position, rotation);
                return;
            }
            SetPose(position, rotation);
            poseUnpublished = true;
        }

        // ---- Physics --------------------------------------------------------------------------------------------------

        internal override void Activate()
        {
            ode = new OdeBody(PhysicsWorld.Handle);
            MassStale = true;
            owner.AddPhysics(this);
            PhysicsWorld.Add(this);
            TakePose();
            foreach (var collider in owner.GetComponentsInChildren<Collider>())
                if (collider.Registered) collider.Attach();
        }

        internal override void Deactivate()
        {
            if (!Registered) return;
            PhysicsWorld.Remove(this);
            owner.RemovePhysics(this);
            var dying = ode;
            ode = null;
            foreach (var collider in Colliders.ToArray()) collider.Attach();
            dying.Destroy();
            velocity = spin = Vector3.zero;
            ClearForces();
        }

        internal void TakePose()
        {
            var transform = owner.TransformUnchecked;
            SetPose(transform.position, transform.rotation);
        }

        void SetPose(Vector3 position, Quaternion rotation)
        {
            PosePosition = position;
            PoseRotation = rotation;
            ode.SetPose(position + rotation * CenterOfMass, rotation);
            foreach (var collider in Colliders) collider.FollowBody();
        }

        /// Mass, centre and inertia from the colliders, as if they had one density; a body without any turns like a ball of 1 m.
        void RefreshMass()
        {
            MassStale = false;
            var center = ode.SetMass(ownMass, Colliders, ownConstraints, kinematic);
            if (!center.Equals(CenterOfMass))
            {
                CenterOfMass = center;
                foreach (var collider in Colliders) collider.GeomMoved();
            }
            SetPose(PosePosition, PoseRotation);
        }

        /// Velocity for the coming step: forces and gravity, then damping, then the limit, in PhysX's order.
        internal void BeforeStep(float step)
        {
            if (MassStale) RefreshMass();
            if (hasTarget && !kinematic)
            {
                hasTarget = false;
                SetPose(targetPosition, targetRotation);
                poseUnpublished = true;
            }
            if (kinematic)
            {
                velocity = hasTarget ? (targetPosition - PosePosition) / step : Vector3.zero;
                spin = hasTarget ? SpinTo(targetRotation, step) : Vector3.zero;
                if (hasTarget) ode.SetEnabled(true);
            }
            else if (ode.Enabled)
            {
                if (useGravity) accelerationDue += Physics.gravity;
                velocity += accelerationDue * step + velocityDue;
                spin += angularAccelerationDue * step + spinDue;
                velocity *= Mathf.Max(0f, 1f - linearDamping * step);
                spin *= Mathf.Max(0f, 1f - angularDamping * step);
                Limit();
                var torque = torqueDue + angularImpulseDue / step;
                if (!torque.Equals(Vector3.zero)) ode.AddTorque(torque);
            }
            ClearForces();
            ode.SetVelocity(velocity, spin);
        }

        Vector3 SpinTo(Quaternion target, float step)
        {
            (target * Quaternion.Inverse(PoseRotation)).ToAngleAxis(out var angle, out var axis);
            if (angle > 180f) angle -= 360f;
            return axis * (angle * Mathf.Deg2Rad / step);
        }

        void Limit()
        {
            velocity = Vector3.ClampMagnitude(velocity, maxLinearVelocity);
            spin = Vector3.ClampMagnitude(spin, maxAngularVelocity);
            if (ownConstraints == RigidbodyConstraints.None) return;
            if ((ownConstraints & RigidbodyConstraints.FreezePositionX) != 0) velocity.x = 0f;
            if ((ownConstraints & RigidbodyConstraints.FreezePositionY) != 0) velocity.y = 0f;
            if ((ownConstraints & RigidbodyConstraints.FreezePositionZ) != 0) velocity.z = 0f;
            if ((ownConstraints & RigidbodyConstraints.FreezeRotation) == 0) return;
            var local = Quaternion.Inverse(PoseRotation) * spin;
            if ((ownConstraints & RigidbodyConstraints.FreezeRotationX) != 0) local.x = 0f;
            if ((ownConstraints & RigidbodyConstraints.FreezeRotationY) != 0) local.y = 0f;
            if ((ownConstraints & RigidbodyConstraints.FreezeRotationZ) != 0) local.z = 0f;
            spin = PoseRotation * local;
        }

        /// Takes the step's result over, holds what is frozen in place, and moves the transform.
        internal void AfterStep()
        {
            if (kinematic)
            {
                if (hasTarget) SetPose(targetPosition, targetRotation);
                else if (!poseUnpublished) return;
                hasTarget = false;
                velocity = spin = Vector3.zero;
            }
            else if (ode.Enabled) ReadStep();
            else if (!poseUnpublished) return;
            poseUnpublished = false;
            owner.TransformUnchecked.Place(PosePosition, PoseRotation);
        }

        void ReadStep()
        {
            velocity = ode.Velocity;
            spin = ode.Spin;
            var oldPosition = PosePosition;
            var heldRotation = freezeRotation;
            if (!heldRotation) PoseRotation = ode.Rotation;
            PosePosition = ode.Position - PoseRotation * CenterOfMass;
            Limit();
            if ((ownConstraints & RigidbodyConstraints.FreezePositionX) != 0) PosePosition.x = oldPosition.x;
            if ((ownConstraints & RigidbodyConstraints.FreezePositionY) != 0) PosePosition.y = oldPosition.y;
            if ((ownConstraints & RigidbodyConstraints.FreezePositionZ) != 0) PosePosition.z = oldPosition.z;
            if (ownConstraints != RigidbodyConstraints.None) SetPose(PosePosition, PoseRotation);
            else
                for (var index = 0; index < Colliders.Count; index++) Colliders[index].FollowBody();
        }

        internal override void CopyFrom(Component original)
        {
            var other = (Rigidbody)original;
            ownMass = other.ownMass;
            kinematic = other.kinematic;
            ownConstraints = other.ownConstraints;
            useGravity = other.useGravity;
            linearDamping = other.linearDamping;
            angularDamping = other.angularDamping;
            maxLinearVelocity = other.maxLinearVelocity;
            maxAngularVelocity = other.maxAngularVelocity;
            collisionDetectionMode = other.collisionDetectionMode;
            interpolation = other.interpolation;
        }
    }
}
