using System;

namespace UnityEngine
{
    /// Queries and contacts see the shape at the pose that physics last took over, not at the transform's.
    public class Collider : Component
    {
        bool ownEnabled = true;
        bool ownIsTrigger;
        PhysicsMaterial assignedMaterial;
        bool ownsMaterial;

        internal bool Registered { get; private set; }
        /// Counts registrations: what was known of an earlier one no longer holds.
        internal int Registration { get; private set; }
        internal Rigidbody Body { get; private set; }
        internal Shape World;
        internal Vector3 Min, Max;
        internal IntPtr Geom;

        Shape local; // relative to the body, or to the world without one
        bool geomStale = true;

        public bool enabled
        {
            get => ownEnabled;
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
            get => ownIsTrigger;
            set
            {
                ownIsTrigger = value;
                if (!(Body is null)) Body.MassStale = true;
            }
        }

        public Rigidbody attachedRigidbody => Registered ? Body : null;

        public Bounds bounds => Registered ? new Bounds((Min + Max) * 0.5f, Max - Min) : default;

        public PhysicsMaterial sharedMaterial
        {
            get => assignedMaterial;
            set
            {
                assignedMaterial = value;
                ownsMaterial = false;
            }
        }

        /// A copy of the shared material, made at the first access and this collider's own.
        public PhysicsMaterial material
        {
            get
            {
                if (ownsMaterial) return assignedMaterial;
                var source = EffectiveMaterial;
                assignedMaterial = new PhysicsMaterial(source.name + " (Instance)")
                {
                    bounciness = source.bounciness, dynamicFriction = source.dynamicFriction, staticFriction = source.staticFriction,
                    frictionCombine = source.frictionCombine, bounceCombine = source.bounceCombine,
                };
                ownsMaterial = true;
                return assignedMaterial;
            }
            set
            {
                assignedMaterial = value;
                ownsMaterial = value;
            }
        }

        internal PhysicsMaterial EffectiveMaterial => assignedMaterial ? assignedMaterial : PhysicsMaterial.Default;
        internal bool IsStatic => Body is null;
        internal Shape Local => local;

        /// Whether physics knows the shape's closest points.
        internal virtual bool HasClosestPoint => true;

        public Vector3 ClosestPoint(Vector3 position)
        {
            if (HasClosestPoint) return Registered ? World.ClosestPoint(position) : position;
            Debug.LogError("Physics.ClosestPoint can only be used with a BoxCollider, SphereCollider, CapsuleCollider and a convex MeshCollider.", this);
            return position;
        }
        public Vector3 ClosestPointOnBounds(Vector3 position) => bounds.ClosestPoint(position);

        public bool Raycast(Ray ray, out RaycastHit hitInfo, float maxDistance) =>
            Queries.Hits(this, ray.origin, ray.direction, maxDistance, out hitInfo);

        /// The shape in the transform's frame, scaled.
        internal virtual Shape ScaledShape(Vector3 scale) => throw new NotSupportedException("A plain Collider has no shape: use one of its subclasses.");

        internal Shape ShapeAt(Vector3 position, Quaternion rotation) => ScaledShape(transform.lossyScale).Within(position, rotation);

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
            PhysicsWorld.Add(this);
        }

        void Unregister()
        {
            Registered = false;
            owner.RemovePhysics(this);
            Detach();
            PhysicsWorld.Remove(this);
        }

        /// Joins the nearest active body at or above its object.
        internal void Attach()
        {
            var nearest = NearestBody();
            if (!ReferenceEquals(nearest, Body))
            {
                Detach();
                Body = nearest;
                if (!(Body is null))
                {
                    Body.Colliders.Add(this);
                    Body.MassStale = true;
                }
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
            DropGeom();
            if (Body is null) return;
            Body.Colliders.Remove(this);
            Body.MassStale = true;
            Body = null;
        }

        /// Takes the transform's pose and scale over.
        internal void TakePose()
        {
            var transform = owner.TransformUnchecked;
            var shape = ScaledShape(transform.lossyScale);
            if (Body is null) shape = shape.Within(transform.position, transform.rotation);
            else if (!ReferenceEquals(Body.owner, owner))
            {
                var unturn = Quaternion.Inverse(Body.owner.TransformUnchecked.rotation);
                shape = shape.Within(unturn * (transform.position - Body.owner.TransformUnchecked.position), unturn * transform.rotation);
            }
            var same = local.Center.Equals(shape.Center) && local.Rotation.Equals(shape.Rotation) && local.Half.Equals(shape.Half)
                && local.Radius == shape.Radius;
            local = shape;
            if (!same)
            {
                geomStale = true;
                if (!(Body is null)) Body.MassStale = true;
            }
            FollowBody();
        }

        /// A property of the shape changed: seen at once, at the pose known to physics.
        internal void ShapeChanged()
        {
            if (Registered) TakePose();
        }

        internal void FollowBody()
        {
            World = Body is null ? local : local.Within(Body.PosePosition, Body.PoseRotation);
            var reach = World.Reach;
            Min = World.Center - reach;
            Max = World.Center + reach;
            PhysicsWorld.GridStale = true;
        }

        internal void GeomMoved() => geomStale = true;

        /// Brings the ODE geometry in line before a step.
        internal unsafe void RefreshGeom()
        {
            if (!geomStale) return;
            DropGeom();
            var half = local.Half;
            Geom = local.IsSphere ? Ode.dCreateSphere(IntPtr.Zero, local.Radius)
                : local.IsCapsule ? Ode.dCreateCapsule(IntPtr.Zero, local.Radius, 2f * half.z)
                : Ode.dCreateBox(IntPtr.Zero, 2f * half.x, 2f * half.y, 2f * half.z);
            var rotation = stackalloc double[4] { local.Rotation.w, local.Rotation.x, local.Rotation.y, local.Rotation.z };
            if (Body is null)
            {
                Ode.dGeomSetPosition(Geom, local.Center.x, local.Center.y, local.Center.z);
                Ode.dGeomSetQuaternion(Geom, rotation);
            }
            else
            {
                Ode.dGeomSetBody(Geom, Body.Handle);
                var center = local.Center - Body.CenterOfMass;
                if (!center.Equals(Vector3.zero)) Ode.dGeomSetOffsetPosition(Geom, center.x, center.y, center.z);
                if (!local.Rotation.Equals(Quaternion.identity)) Ode.dGeomSetOffsetQuaternion(Geom, rotation);
            }
            geomStale = false;
        }

        void DropGeom()
        {
            if (Geom != IntPtr.Zero) Ode.dGeomDestroy(Geom);
            Geom = IntPtr.Zero;
            geomStale = true;
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
