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

    /// A body. Its velocity and pose are the results of the last step, or the values that scripts set since then. Forces affect them only in the next step.
    /// Poses are never interpolated between steps.
    [DisallowMultipleComponent]
    public class Rigidbody : Component
    {
        const float DefaultDepenetration = 10f, DefaultSleepThreshold = 0.005f;
        const int DefaultIterations = 6, DefaultVelocityIterations = 1;

        internal readonly List<Collider> Colliders = new List<Collider>();
        /// PhysX's handle of the body; none while the body is inactive.
        internal int Handle = Physx.None;
        internal int IndexInNested = -1;

        Transform activeTransform; // while it is active
        long changesAtStart; // of all transforms, when it became active
        Physx.Motion ownMotion; // while it is not
        float ownMass = 1f;
        bool kinematic, gravity = true;
        RigidbodyConstraints ownConstraints;
        CollisionDetectionMode detection;
        RigidbodyInterpolation ownInterpolation;
        float ownLinearDamping, ownAngularDamping = 0.05f, ownMaxLinear = 1e16f, ownMaxAngular = 7f, ownDepenetration = DefaultDepenetration;
        float ownSleepThreshold = DefaultSleepThreshold;
        int iterations = DefaultIterations, velocityIterations = DefaultVelocityIterations;
        Vector3? ownCenter, ownInertia;
        Quaternion ownInertiaRotation = Quaternion.identity;
        Vector3 targetPosition;
        Quaternion targetRotation;
        int targetStep = -1; // the step that the target was set for

        internal bool Registered => Handle != Physx.None;

        unsafe ref Physx.Motion Motion => ref Handle != Physx.None ? ref PhysicsWorld.Motions[Handle] : ref this.Existing().ownMotion;

        // ---- Properties -----------------------------------------------------------------------------------------------

        public RigidbodyInterpolation interpolation { get => this.Existing().ownInterpolation; set => this.Existing().ownInterpolation = value; }

        public bool useGravity
        {
            get => this.Existing().gravity;
            set
            {
                if (gravity != value) WakeUp();
                gravity = value;
                Order(Physx.Order.Gravity, new Vector3(value ? 1f : 0f, 0f, 0f));
            }
        }

        public float linearDamping
        {
            get => this.Existing().ownLinearDamping;
            set
            {
                ownLinearDamping = Mathf.Max(0f, value);
                SendDamping();
            }
        }

        public float angularDamping
        {
            get => this.Existing().ownAngularDamping;
            set
            {
                ownAngularDamping = Mathf.Max(0f, value);
                SendDamping();
            }
        }

        public float maxLinearVelocity
        {
            get => this.Existing().ownMaxLinear;
            set
            {
                ownMaxLinear = Mathf.Clamp(value, 0f, 1e16f); // PhysX squares it
                SendLimits();
            }
        }

        public float maxAngularVelocity
        {
            get => this.Existing().ownMaxAngular;
            set
            {
                ownMaxAngular = Mathf.Clamp(value, 0f, 1e16f);
                SendLimits();
            }
        }

        /// Maximum speed at which the solver separates the body from overlapping shapes.
        public float maxDepenetrationVelocity
        {
            get => this.Existing().ownDepenetration;
            set
            {
                ownDepenetration = Mathf.Clamp(value, 1e-3f, 1e16f);
                SendLimits();
            }
        }

        public CollisionDetectionMode collisionDetectionMode
        {
            get => this.Existing().detection;
            set
            {
                detection = value;
                Order(Physx.Order.Detection, new Vector3((int)value, 0f, 0f));
                foreach (var collider in Colliders) collider.Refresh();
            }
        }

        /// Kinetic energy per kilogram below which the body falls asleep.
        public float sleepThreshold
        {
            get => this.Existing().ownSleepThreshold;
            set
            {
                ownSleepThreshold = Mathf.Max(0f, value);
                Order(Physx.Order.SleepBelow, new Vector3(ownSleepThreshold, 0f, 0f));
            }
        }

        public int solverIterations
        {
            get => this.Existing().iterations;
            set
            {
                iterations = Mathf.Clamp(value, 1, 255);
                Order(Physx.Order.Iterations, new Vector3(iterations, velocityIterations, 0f));
            }
        }

        public int solverVelocityIterations
        {
            get => this.Existing().velocityIterations;
            set
            {
                velocityIterations = Mathf.Clamp(value, 1, 255);
                Order(Physx.Order.Iterations, new Vector3(iterations, velocityIterations, 0f));
            }
        }

        public float mass
        {
            get => this.Existing().ownMass;
            set
            {
                value = Mathf.Clamp(value, 1e-7f, 1e9f);
                if (ownMass != value) WakeUp();
                ownMass = value;
                Order(Physx.Order.Mass, new Vector3(ownMass, 0f, 0f));
            }
        }

        public bool isKinematic
        {
            get => this.Existing().kinematic;
            set
            {
                ThrowIfDestroyed();
                if (kinematic == value) return;
                kinematic = value;
                // A body that becomes dynamic keeps the velocity of its last kinematic motion.
                if (value) Motion.Velocity = Motion.Spin = Vector3.zero;
                Motion.Asleep = 0;
                // Only kinematic bodies can have some kinds of shapes. Such shapes must be removed before the body becomes dynamic, and added after it
                // became kinematic.
                if (!value) RefreshColliders();
                Order(Physx.Order.Kinematic, new Vector3(value ? 1f : 0f, 0f, 0f));
                Order(Physx.Order.Detection, new Vector3((int)detection, 0f, 0f));
                if (value) RefreshColliders();
            }
        }

        public RigidbodyConstraints constraints
        {
            get => this.Existing().ownConstraints;
            set
            {
                if (ownConstraints != value) WakeUp();
                ownConstraints = value;
                Order(Physx.Order.Freeze, new Vector3((int)value >> 1, 0f, 0f));
            }
        }

        public bool freezeRotation
        {
            get => (constraints & RigidbodyConstraints.FreezeRotation) == RigidbodyConstraints.FreezeRotation;
            set => constraints = value ? ownConstraints | RigidbodyConstraints.FreezeRotation : ownConstraints & ~RigidbodyConstraints.FreezeRotation;
        }

        bool TakesVelocity(string kind)
        {
            ThrowIfDestroyed();
            if (kinematic) Debug.LogWarning($"Setting {kind} velocity of a kinematic body is not supported.", this);
            return !kinematic && Registered; // as in Unity, setting the velocity of an inactive body has no effect
        }

        public Vector3 linearVelocity
        {
            get => Motion.Velocity;
            set
            {
                if (!Finite.Accepts(value, "Rigidbody.linearVelocity", this) || !TakesVelocity("linear")) return;
                ref var motion = ref Motion;
                motion.Velocity = value;
                if (!value.Equals(Vector3.zero)) motion.Asleep = 0;
                Order(Physx.Order.Velocity, value);
            }
        }

        public Vector3 angularVelocity
        {
            get => Motion.Spin;
            set
            {
                if (!Finite.Accepts(value, "Rigidbody.angularVelocity", this) || !TakesVelocity("angular")) return;
                value = WithoutFrozen(value);
                ref var motion = ref Motion;
                motion.Spin = value;
                if (!value.Equals(Vector3.zero)) motion.Asleep = 0;
                Order(Physx.Order.Spin, value);
            }
        }

        /// Returns an angular velocity without its components about frozen axes of the inertia tensor.
        Vector3 WithoutFrozen(Vector3 spin)
        {
            if (freezeRotation) return Vector3.zero;
            if ((ownConstraints & RigidbodyConstraints.FreezeRotation) == 0) return spin;
            Inertia(out var turn);
            var axes = rotation * turn;
            spin = Quaternion.Inverse(axes) * spin;
            for (var axis = 0; axis < 3; axis++)
                if (((int)ownConstraints & (int)RigidbodyConstraints.FreezeRotationX << axis) != 0) spin[axis] = 0f;
            return axes * spin;
        }

        /// Position of the body in physics. If it is set, the transform moves at the next step.
        public Vector3 position
        {
            get => Registered ? Motion.Pose.Position : transform.position;
            set => Teleport(value, rotation);
        }

        public Quaternion rotation
        {
            get => Registered ? Motion.Pose.Rotation : transform.rotation;
            set
            {
                if (AcceptsRotation(value, "Rigidbody.rotation")) Teleport(position, value.normalized);
            }
        }

        /// As in Unity, bodies reject rotations that are not normalised, for example `default`.
        bool AcceptsRotation(Quaternion value, string what)
        {
            ThrowIfDestroyed();
            if (!Finite.Accepts(value, what, this)) return false;
            if (Mathf.Abs(Quaternion.Dot(value, value) - 1f) < 1e-3f) return true;
            Debug.LogError($"Rotation quaternions must be unit length. {what} of '{NameImpl}' is not set to {value}.", this);
            return false;
        }

        // ---- Mass -----------------------------------------------------------------------------------------------------

        /// Centre of mass in the body's frame. Unless it is set, it is computed from the body's colliders.
        public unsafe Vector3 centerOfMass
        {
            get
            {
                if (!Registered) return this.Existing().ownCenter ?? Vector3.zero;
                PhysicsWorld.Flush();
                Vector3 center;
                Physx.physics_mass_center(PhysicsWorld.Handle, Handle, &center);
                return center;
            }
            set
            {
                if (!Finite.Accepts(value, "Rigidbody.centerOfMass", this)) return;
                ownCenter = value;
                SendCenter();
            }
        }

        public bool automaticCenterOfMass
        {
            get => this.Existing().ownCenter == null;
            set
            {
                ownCenter = value ? (Vector3?)null : centerOfMass;
                SendCenter();
            }
        }

        public void ResetCenterOfMass() => automaticCenterOfMass = true;

        public Vector3 worldCenterOfMass => position + rotation * centerOfMass;

        public Vector3 inertiaTensor
        {
            get => Inertia(out _);
            set
            {
                if (!Finite.Accepts(value, "Rigidbody.inertiaTensor", this)) return;
                // As in Unity, 0 locks the rotation about an axis.
                if (Mathf.Min(value.x, Mathf.Min(value.y, value.z)) < 0f)
                {
                    Debug.LogError($"Rigidbody.inertiaTensor must not be negative. Input is {value}.", this);
                    return;
                }
                Inertia(out ownInertiaRotation);
                ownInertia = value;
                SendInertia();
            }
        }

        public Quaternion inertiaTensorRotation
        {
            get
            {
                Inertia(out var turn);
                return turn;
            }
            set
            {
                if (!Finite.Accepts(value, "Rigidbody.inertiaTensorRotation", this)) return;
                ownInertia = Inertia(out _);
                ownInertiaRotation = value.normalized;
                SendInertia();
            }
        }

        public bool automaticInertiaTensor
        {
            get => this.Existing().ownInertia == null;
            set
            {
                ownInertia = value ? (Vector3?)null : Inertia(out ownInertiaRotation);
                SendInertia();
            }
        }

        public void ResetInertiaTensor() => automaticInertiaTensor = true;

        unsafe Vector3 Inertia(out Quaternion turn)
        {
            turn = this.Existing().ownInertiaRotation;
            if (!Registered) return ownInertia ?? Vector3.one;
            PhysicsWorld.Flush();
            Vector3 diagonal;
            Quaternion about;
            Physx.physics_inertia(PhysicsWorld.Handle, Handle, &diagonal, &about);
            turn = about;
            return diagonal;
        }

        // ---- Control --------------------------------------------------------------------------------------------------

        /// Moves the body to a position. A kinematic body moves there in the next step and pushes other bodies. A dynamic body is placed there immediately.
        public void MovePosition(Vector3 position) => Move(position, HasTarget ? targetRotation : rotation);

        public void MoveRotation(Quaternion rotation) => Move(HasTarget ? targetPosition : position, rotation);

        bool HasTarget => kinematic && targetStep == PhysicsWorld.StepCount;

        public void Move(Vector3 position, Quaternion rotation)
        {
            if (!Finite.Accepts(position, "Rigidbody.MovePosition", this) || !AcceptsRotation(rotation, "Rigidbody.MoveRotation")) return;
            targetPosition = position;
            targetRotation = rotation.normalized;
            targetStep = PhysicsWorld.StepCount;
            if (kinematic) OrderPose(Physx.Order.Target, targetPosition, targetRotation);
            else Teleport(targetPosition, targetRotation);
        }

        public void AddForce(Vector3 force) => AddForce(force, ForceMode.Force);
        public void AddForce(float x, float y, float z) => AddForce(new Vector3(x, y, z));
        public void AddForce(float x, float y, float z, ForceMode mode) => AddForce(new Vector3(x, y, z), mode);

        /// Adds a force, which takes effect in the next step. As in Unity, a zero force does not wake the body.
        public void AddForce(Vector3 force, ForceMode mode)
        {
            ThrowIfDestroyed();
            if (!Finite.Accepts(force, "Rigidbody.AddForce", this) || kinematic || force.Equals(Vector3.zero)) return;
            Motion.Asleep = 0;
            Order(Physx.Order.Force + Number(mode), force);
        }

        public void AddRelativeForce(Vector3 force) => AddRelativeForce(force, ForceMode.Force);
        public void AddRelativeForce(Vector3 force, ForceMode mode) => AddForce(rotation * force, mode);
        public void AddRelativeForce(float x, float y, float z) => AddRelativeForce(new Vector3(x, y, z));
        public void AddRelativeForce(float x, float y, float z, ForceMode mode) => AddRelativeForce(new Vector3(x, y, z), mode);

        public void AddTorque(Vector3 torque) => AddTorque(torque, ForceMode.Force);
        public void AddTorque(float x, float y, float z) => AddTorque(new Vector3(x, y, z));
        public void AddTorque(float x, float y, float z, ForceMode mode) => AddTorque(new Vector3(x, y, z), mode);

        public void AddTorque(Vector3 torque, ForceMode mode)
        {
            ThrowIfDestroyed();
            if (!Finite.Accepts(torque, "Rigidbody.AddTorque", this) || kinematic || torque.Equals(Vector3.zero)) return;
            Motion.Asleep = 0;
            Order(Physx.Order.Torque + Number(mode), torque);
        }

        static int Number(ForceMode mode) => mode == ForceMode.Acceleration ? 3 : (int)mode;

        public void AddRelativeTorque(Vector3 torque) => AddRelativeTorque(torque, ForceMode.Force);
        public void AddRelativeTorque(Vector3 torque, ForceMode mode) => AddTorque(rotation * torque, mode);
        public void AddRelativeTorque(float x, float y, float z) => AddRelativeTorque(new Vector3(x, y, z));
        public void AddRelativeTorque(float x, float y, float z, ForceMode mode) => AddRelativeTorque(new Vector3(x, y, z), mode);

        public void AddForceAtPosition(Vector3 force, Vector3 position) => AddForceAtPosition(force, position, ForceMode.Force);

        /// Adds a force at a position. With the modes `Acceleration` and `VelocityChange`, the rotation does not depend on the inertia.
        public void AddForceAtPosition(Vector3 force, Vector3 position, ForceMode mode)
        {
            AddForce(force, mode);
            AddTorque(Vector3.Cross(position - worldCenterOfMass, force), mode);
        }

        public Vector3 GetPointVelocity(Vector3 worldPoint) => Motion.Velocity + Vector3.Cross(Motion.Spin, worldPoint - worldCenterOfMass);
        public Vector3 GetRelativePointVelocity(Vector3 relativePoint) => GetPointVelocity(position + rotation * relativePoint);

        public void Sleep()
        {
            if (kinematic) return;
            Motion.Velocity = Motion.Spin = Vector3.zero;
            Motion.Asleep = Registered ? 1 : 0;
            Order(Physx.Order.Sleep, Vector3.zero);
        }

        /// As in Unity, changes of gravity, constraints, mass and colliders do this too.
        public void WakeUp()
        {
            if (kinematic) return;
            Motion.Asleep = 0;
            Order(Physx.Order.Wake, Vector3.zero);
        }

        public bool IsSleeping() => Motion.Asleep != 0;

        // ---- Queries --------------------------------------------------------------------------------------------------

        public bool SweepTest(Vector3 direction, out RaycastHit hitInfo, float maxDistance = Mathf.Infinity,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.Sweep(this.Existing(), direction, out hitInfo, maxDistance, queryTriggerInteraction);

        public RaycastHit[] SweepTestAll(Vector3 direction, float maxDistance = Mathf.Infinity,
            QueryTriggerInteraction queryTriggerInteraction = QueryTriggerInteraction.UseGlobal) =>
            Queries.SweepAll(this.Existing(), direction, maxDistance, queryTriggerInteraction);

        /// Returns the nearest point on the bounds of the body's colliders.
        public Vector3 ClosestPointOnBounds(Vector3 position)
        {
            var best = position;
            var least = float.PositiveInfinity;
            foreach (var collider in this.Existing().Colliders)
            {
                var point = collider.ClosestPointOnBounds(position);
                var distance = (point - position).sqrMagnitude;
                if (distance >= least) continue;
                least = distance;
                best = point;
            }
            return best;
        }

        // ---- Physics --------------------------------------------------------------------------------------------------

        void Order(Physx.Order order, Vector3 value)
        {
            if (Registered) PhysicsWorld.Order(Handle, order, value);
            else ThrowIfDestroyed();
        }

        void OrderPose(Physx.Order order, Vector3 position, Quaternion rotation)
        {
            if (Registered) PhysicsWorld.Order(Handle, order, position, rotation);
            else ThrowIfDestroyed();
        }

        // PhysX rejects infinite damping, which stops a body in Unity.
        void SendDamping() => Order(Physx.Order.Damping, new Vector3(Mathf.Min(ownLinearDamping, 1e16f), Mathf.Min(ownAngularDamping, 1e16f), 0f));
        void SendLimits() => Order(Physx.Order.Limits, new Vector3(ownMaxLinear, ownMaxAngular, ownDepenetration));

        void SendCenter()
        {
            WakeUp();
            OrderPose(Physx.Order.MassCenter, ownCenter ?? Vector3.zero, new Quaternion(ownCenter == null ? 0f : 1f, 0f, 0f, 0f));
        }

        void SendInertia()
        {
            WakeUp();
            OrderPose(Physx.Order.Inertia, ownInertia ?? Vector3.zero, ownInertia == null ? default : ownInertiaRotation);
        }

        void SendAll()
        {
            Order(Physx.Order.Mass, new Vector3(ownMass, 0f, 0f));
            if (kinematic) Order(Physx.Order.Kinematic, Vector3.right);
            if (!gravity) Order(Physx.Order.Gravity, Vector3.zero);
            SendDamping();
            SendLimits();
            Order(Physx.Order.Freeze, new Vector3((int)ownConstraints >> 1, 0f, 0f));
            if (detection != CollisionDetectionMode.Discrete) Order(Physx.Order.Detection, new Vector3((int)detection, 0f, 0f));
            if (ownSleepThreshold != DefaultSleepThreshold) Order(Physx.Order.SleepBelow, new Vector3(ownSleepThreshold, 0f, 0f));
            if (iterations != DefaultIterations || velocityIterations != DefaultVelocityIterations)
                Order(Physx.Order.Iterations, new Vector3(iterations, velocityIterations, 0f));
            if (ownCenter != null) SendCenter();
            if (ownInertia != null) SendInertia();
        }

        void Teleport(Vector3 position, Quaternion rotation)
        {
            if (!Finite.Accepts(position, "Rigidbody.position", this) || !Finite.Accepts(rotation, "Rigidbody.rotation", this)) return;
            if (!Registered)
            {
                transform.SetPositionAndRotation(position, rotation);
                return;
            }
            SetPose(position, rotation);
            PhysicsWorld.PublishAfterStep(this);
        }

        internal override unsafe void Activate()
        {
            activeTransform = owner.TransformUnchecked;
            changesAtStart = Transform.Changes;
            activeTransform.awaitsPoseSync = false;
            var pose = new Physx.Pose(activeTransform.position, activeTransform.rotation);
            Handle = Physx.physics_actor_create(PhysicsWorld.Handle, 1, &pose);
            PhysicsWorld.Add(this);
            ownMotion.Pose = pose;
            Motion = ownMotion;
            activeTransform.Follow(Handle);
            PhysicsWorld.SetNested(this, !(activeTransform.parentOrNull is null));
            SendAll();
            owner.AddPhysics(this);
            foreach (var collider in owner.GetComponentsInChildren<Collider>())
                if (collider.Registered) collider.Attach();
            PhysicsWorld.Connect(this);
        }

        internal override void Deactivate()
        {
            if (!Registered) return;
            owner.RemovePhysics(this);
            PhysicsWorld.Flush();
            PhysicsWorld.Disconnect(this);
            PhysicsWorld.Remove(this);
            activeTransform.Follow(Physx.None);
            var oldHandle = Handle;
            Handle = Physx.None;
            foreach (var collider in Colliders.ToArray()) collider.Attach();
            Physx.physics_actor_destroy(PhysicsWorld.Handle, oldHandle);
            ownMotion = default;
        }

        internal void RefreshColliders()
        {
            foreach (var collider in Colliders) collider.Refresh();
        }

        /// The pose that the body will have after the next sync.
        internal Physx.Pose NextPose => activeTransform.IsBeforeSync && activeTransform.HasChangedSince(changesAtStart)
            ? new Physx.Pose(activeTransform.position, activeTransform.rotation) : Motion.Pose;

        /// Copies the transform's pose if it differs. Changes from before the body became active must not undo a pose that a script set since then.
        internal void TakePose()
        {
            var transform = owner.TransformUnchecked;
            if (!transform.HasChangedSince(changesAtStart)) return;
            var position = transform.position;
            var rotation = transform.rotation;
            ref var pose = ref Motion.Pose;
            if (!position.Equals(pose.Position) || !rotation.Equals(pose.Rotation)) SetPose(position, rotation);
        }

        void SetPose(Vector3 position, Quaternion rotation)
        {
            // The transform keeps the pose of the last step until the next step.
            activeTransform.Follow();
            ref var motion = ref Motion;
            motion.Pose = new Physx.Pose(position, rotation);
            motion.Asleep = 0;
            OrderPose(Physx.Order.Pose, position, rotation);
        }

        /// Moves the transform, which has a parent, if the last step moved the body. Otherwise, the body follows the transform if the step moved a parent.
        internal void UpdateTransform()
        {
            var step = PhysicsWorld.StepCount;
            var isLed = kinematic && targetStep != step - 1;
            if (isLed) activeTransform.SkipStep();
            else activeTransform.Follow();
            if ((isLed || Motion.Step != step) && activeTransform.HasMovedParent) PhysicsWorld.TransformChanged(activeTransform);
        }

        internal void Publish()
        {
            activeTransform.Place(Motion.Pose.Position, Motion.Pose.Rotation);
            foreach (var child in activeTransform.children) PhysicsWorld.TransformChanged(child);
        }

        /// As in Unity, limits of speeds, the sleep threshold and solver iterations are not serialised.
        internal override void CopyFrom(Component original)
        {
            var other = (Rigidbody)original;
            ownMass = other.ownMass;
            kinematic = other.kinematic;
            ownConstraints = other.ownConstraints;
            gravity = other.gravity;
            ownLinearDamping = other.ownLinearDamping;
            ownAngularDamping = other.ownAngularDamping;
            detection = other.detection;
            ownInterpolation = other.ownInterpolation;
            ownCenter = other.ownCenter;
            ownInertia = other.ownInertia;
            ownInertiaRotation = other.ownInertiaRotation;
        }
    }
}
