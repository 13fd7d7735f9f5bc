using System;

namespace UnityEngine
{
    /// Base of all colliders. Queries and contacts use the pose that was last synchronised to physics, not the current pose of the transform.
    public class Collider : Component
    {
        const float Tolerance = 1e-6f;
        const float ScaleTolerance = 1e-5f;

        bool ownEnabled = true;
        bool ownIsTrigger;
        PhysicsMaterial assignedMaterial, ownMaterial;

        internal bool Registered { get; private set; }
        /// Number of times that the collider was registered. Information with a lower number is stale.
        internal int Registration { get; private set; }
        internal Rigidbody Body { get; private set; }
        /// PhysX's handle of the shape; none if the collider is not registered or has no shape.
        internal int Handle { get; private set; } = Physx.None;

        int staticActor = Physx.None; // the static actor of a collider without a body
        Physx.Shape known; // the shape as last sent to PhysX
        Vector3 position, scale; // of this object in the actor's frame
        Quaternion rotation;
        string refusal; // the last logged reason for a missing shape

        public bool enabled
        {
            get => this.Existing().ownEnabled;
            set
            {
                ThrowIfDestroyed();
                if (ownEnabled == value) return;
                ownEnabled = value;
                if (!owner.activeInHierarchy) return;
                if (value) Register();
                else Unregister();
            }
        }

        public bool isTrigger
        {
            get => this.Existing().ownIsTrigger;
            set
            {
                ThrowIfDestroyed();
                ownIsTrigger = value;
                Refresh();
            }
        }

        public Rigidbody attachedRigidbody => this.Existing().Registered ? Body : null;

        public unsafe Bounds bounds
        {
            get
            {
                ThrowIfDestroyed();
                if (Handle == Physx.None) return default;
                Vector3 least, most;
                PhysicsWorld.Flush();
                Physx.physics_shape_bounds(PhysicsWorld.Handle, Handle, &least, &most);
                return new Bounds((least + most) * 0.5f, most - least);
            }
        }

        public PhysicsMaterial sharedMaterial
        {
            get => this.Existing().assignedMaterial;
            set
            {
                ThrowIfDestroyed();
                assignedMaterial = value;
                Refresh();
            }
        }

        /// This collider's copy of the assigned material, created when it is read.
        public PhysicsMaterial material
        {
            get
            {
                ThrowIfDestroyed();
                if (ownMaterial && ReferenceEquals(ownMaterial, assignedMaterial)) return ownMaterial;
                var name = assignedMaterial ? assignedMaterial.name : "Default";
                return assignedMaterial = ownMaterial = new PhysicsMaterial(name + " (Instance)") { Values = MaterialValues };
            }
            set => sharedMaterial = value;
        }

        Physx.Material MaterialValues => assignedMaterial ? assignedMaterial.Values : PhysicsMaterial.Defaults;

        /// Whether physics can compute closest points of the shape.
        internal virtual bool HasClosestPoint => true;

        public Vector3 ClosestPoint(Vector3 position) => Queries.ClosestPoint(this.Existing(), position);
        public Vector3 ClosestPointOnBounds(Vector3 position) => bounds.ClosestPoint(position);

        public bool Raycast(Ray ray, out RaycastHit hitInfo, float maxDistance) => Queries.RaycastOne(this.Existing(), ray, out hitInfo, maxDistance);

        /// Sets the size of a new collider of an object with a mesh.
        internal virtual void Fit(Mesh mesh) { }

        /// Sets the scaled geometry and its pose in this object's frame. Returns false if the collider has no shape.
        internal virtual bool Describe(Vector3 scale, ref Physx.Shape shape) =>
            throw new NotSupportedException("A plain Collider has no shape: use one of its subclasses.");

        /// Returns false. Logs the reason why the collider has no shape, but not again each time that the object moves.
        internal bool Refuse(string reason)
        {
            if (reason != refusal) Debug.LogError($"{reason} Object '{NameImpl}' has no shape.", this);
            refusal = reason;
            return false;
        }

        /// Returns the centre relative to this object's pose. Under parents with different scales along their axes, the rotation matters too.
        internal Vector3 ScaledCenter(Vector3 center, Vector3 scale)
        {
            var transform = owner.TransformUnchecked;
            if (transform.parentOrNull is null || center.Equals(Vector3.zero)) return Vector3.Scale(center, scale);
            return Quaternion.Inverse(transform.rotation) * transform.TransformVector(center);
        }

        /// Returns the pose that the geometry has when this object has the given pose.
        internal Physx.Pose GeometryAt(Vector3 position, Quaternion rotation)
        {
            var shape = new Physx.Shape();
            Describe(scale, ref shape);
            return new Physx.Pose(position + rotation * shape.Pose.Position, (rotation * shape.Pose.Rotation).normalized);
        }

        internal override void Activate()
        {
            if (ownEnabled) Register();
        }

        internal override void Deactivate()
        {
            if (Registered) Unregister();
        }

        void Register()
        {
            Registered = true;
            Registration++;
            owner.AddPhysics(this);
            Attach();
        }

        void Unregister()
        {
            Registered = false;
            owner.RemovePhysics(this);
            Detach();
            PhysicsWorld.Ignored.Remove(this);
        }

        /// Attaches the collider to the nearest active body on its object or its ancestors.
        internal void Attach()
        {
            var nearest = NearestBody();
            if (!ReferenceEquals(nearest, Body))
            {
                Detach();
                Body = nearest;
                Body?.Colliders.Add(this);
                Body?.WakeUp();
            }
            TakePose();
        }

        Rigidbody NearestBody()
        {
            for (var level = owner.TransformUnchecked; !(level is null); level = level.parentOrNull)
                if (level.owner.physicsParts?.Count > 0 && level.owner.physicsParts[0] is Rigidbody body) return body;
            return null;
        }

        void Detach()
        {
            DropShape();
            if (staticActor != Physx.None)
            {
                // Otherwise, its pending commands would move the next actor with this handle.
                PhysicsWorld.Flush();
                Physx.physics_actor_destroy(PhysicsWorld.Handle, staticActor);
                staticActor = Physx.None;
            }
            if (Body is null) return;
            Body.Colliders.Remove(this);
            Body.WakeUp();
            Body = null;
        }

        /// Copies the transform's pose and scale.
        internal unsafe void TakePose()
        {
            var transform = owner.TransformUnchecked;
            var newScale = transform.lossyScale;
            if (!Near(newScale, scale)) scale = newScale;
            position = Vector3.zero;
            rotation = Quaternion.identity;
            if (Body is null)
            {
                var pose = new Physx.Pose(transform.position, transform.rotation);
                if (staticActor == Physx.None) staticActor = Physx.physics_actor_create(PhysicsWorld.Handle, 0, &pose);
                else PhysicsWorld.Order(staticActor, Physx.Order.Pose, pose.Position, pose.Rotation);
            }
            else if (!ReferenceEquals(Body.owner, owner))
            {
                var unturn = Quaternion.Inverse(Body.owner.TransformUnchecked.rotation);
                position = unturn * (transform.position - Body.owner.TransformUnchecked.position);
                rotation = (unturn * transform.rotation).normalized;
            }
            Refresh();
        }

        /// Applies a changed property of the shape immediately.
        internal void ShapeChanged()
        {
            if (Registered) TakePose();
            else ThrowIfDestroyed();
        }

        /// Updates PhysX's shape with all properties except the transform.
        internal unsafe void Refresh()
        {
            if (!Registered) return;
            var shape = new Physx.Shape();
            if (!Describe(scale, ref shape))
            {
                DropShape();
                return;
            }
            if (!(Body is null))
                shape.Pose = new Physx.Pose(position + rotation * shape.Pose.Position, (rotation * shape.Pose.Rotation).normalized);
            refusal = null;
            shape.Material = MaterialValues;
            shape.Identity = (uint)id;
            shape.Layer = owner.layer;
            shape.Trigger = ownIsTrigger ? 1 : 0;
            shape.Reports = Listening();
            shape.Detection = Body is null ? CollisionDetectionMode.Discrete : Body.collisionDetectionMode;
            if (Handle != Physx.None && Same(shape, known)) return;
            PhysicsWorld.Flush();
            if (Handle != Physx.None && (shape.Trigger != known.Trigger || shape.Geometry.Kind != known.Geometry.Kind)) DropShape();
            if (Handle == Physx.None)
            {
                Handle = Physx.physics_shape_create(PhysicsWorld.Handle, Body is null ? staticActor : Body.Handle, &shape);
                if (Handle != Physx.None) PhysicsWorld.Add(this);
                else Debug.LogError($"The collider of '{NameImpl}' has no shape: {Physx.Error()}", this);
            }
            else if (Physx.physics_shape_change(PhysicsWorld.Handle, Handle, &shape) == 0)
                Debug.LogError($"The collider of '{NameImpl}' keeps its former shape: {Physx.Error()}", this);
            known = shape;
        }

        /// Compares two shapes with a tolerance for rounding errors in the poses of children.
        static bool Same(in Physx.Shape a, in Physx.Shape b)
        {
            return a.Geometry.Kind == b.Geometry.Kind && a.Geometry.Radius == b.Geometry.Radius && a.Geometry.Half.Equals(b.Geometry.Half)
                && a.Geometry.Mesh == b.Geometry.Mesh
                && (a.Pose.Position - b.Pose.Position).sqrMagnitude <= Tolerance * Tolerance * Mathf.Max(1f, a.Pose.Position.sqrMagnitude)
                && Near(a.Pose.Rotation.x, b.Pose.Rotation.x) && Near(a.Pose.Rotation.y, b.Pose.Rotation.y)
                && Near(a.Pose.Rotation.z, b.Pose.Rotation.z) && Near(a.Pose.Rotation.w, b.Pose.Rotation.w)
                && a.Material.StaticFriction == b.Material.StaticFriction && a.Material.DynamicFriction == b.Material.DynamicFriction
                && a.Material.Bounciness == b.Material.Bounciness && a.Material.FrictionCombine == b.Material.FrictionCombine
                && a.Material.BounceCombine == b.Material.BounceCombine
                && a.Identity == b.Identity && a.Layer == b.Layer && a.Trigger == b.Trigger && a.Reports == b.Reports && a.Detection == b.Detection;
        }

        static bool Near(float a, float b) => Mathf.Abs(a - b) <= Tolerance;

        /// Whether two scales differ only by rounding errors, which change the scale of a turning child in each step.
        static bool Near(Vector3 a, Vector3 b) =>
            Mathf.Abs(a.x - b.x) <= ScaleTolerance * Mathf.Abs(b.x) && Mathf.Abs(a.y - b.y) <= ScaleTolerance * Mathf.Abs(b.y)
                && Mathf.Abs(a.z - b.z) <= ScaleTolerance * Mathf.Abs(b.z);

        /// Returns the kinds of reports that some script handles. Overlaps are sent to this object and to its body. Contacts are sent to the body, or to
        /// this object if it has no body.
        Physx.Reports Listening()
        {
            var bodyMessages = Body is null ? owner.touchMessages : Body.owner.touchMessages;
            var reports = Physx.Reports.None;
            if (((owner.touchMessages | bodyMessages) & TouchMessages.Triggers) != 0) reports |= Physx.Reports.Overlaps;
            if ((bodyMessages & TouchMessages.Collisions) != 0) reports |= Physx.Reports.Contacts;
            return reports;
        }

        internal void DropShape()
        {
            if (Handle == Physx.None) return;
            PhysicsWorld.Remove(this);
            Physx.physics_shape_destroy(PhysicsWorld.Handle, Handle);
            Handle = Physx.None;
        }

        internal override void CopyFrom(Component original)
        {
            var other = (Collider)original;
            ownEnabled = other.ownEnabled;
            ownIsTrigger = other.ownIsTrigger;
            assignedMaterial = other.assignedMaterial;
        }
    }
}
