namespace UnityEngine
{
    /// Connects the object's body to another body or to the world. The connection uses the poses that the bodies have when the joint becomes active or changes.
    [RequireComponent(typeof(Rigidbody))]
    public abstract class Joint : Component
    {
        Rigidbody ownConnectedBody;
        Vector3 ownAnchor, ownConnectedAnchor, ownAxis = Vector3.right;
        bool ownAutoConfigure = true, ownCollision;
        float ownBreakForce = Mathf.Infinity, ownBreakTorque = Mathf.Infinity;

        internal int Handle = Physx.None;
        bool active;

        public Rigidbody connectedBody { get => ownConnectedBody; set => Set(ref ownConnectedBody, value); }
        /// Axis of a hinge in the body's frame.
        public Vector3 axis { get => ownAxis; set => Set(ref ownAxis, value); }
        public Vector3 anchor { get => ownAnchor; set => Set(ref ownAnchor, value); }

        /// Anchor in the frame of the connected body or of the world.
        public Vector3 connectedAnchor
        {
            get => ownConnectedAnchor;
            set
            {
                ownAutoConfigure = false;
                Set(ref ownConnectedAnchor, value);
            }
        }

        /// Whether the connected anchor is computed from the anchor.
        public bool autoConfigureConnectedAnchor { get => ownAutoConfigure; set => Set(ref ownAutoConfigure, value); }

        /// Force in newtons above which `OnJointBreak` is sent and the joint is destroyed.
        public float breakForce { get => ownBreakForce; set => Set(ref ownBreakForce, value); }
        public float breakTorque { get => ownBreakTorque; set => Set(ref ownBreakTorque, value); }
        public bool enableCollision { get => ownCollision; set => Set(ref ownCollision, value); }

        internal Rigidbody Body => owner.GetComponent<Rigidbody>();

        internal abstract void Describe(ref Physx.Joint joint);

        internal void Set<T>(ref T field, T value)
        {
            field = value;
            Refresh();
        }

        internal override void Activate()
        {
            active = true;
            PhysicsWorld.Add(this);
            Refresh();
        }

        internal override void Deactivate()
        {
            active = false;
            Drop();
            PhysicsWorld.Remove(this);
        }

        internal bool Connects(Rigidbody body) => ReferenceEquals(body, ownConnectedBody) || ReferenceEquals(body.owner, owner);

        /// Recreates PhysX's joint.
        internal unsafe void Refresh()
        {
            if (!active) return;
            Drop();
            var body = Body;
            if (body is null || !body.Registered || !(ownConnectedBody is null) && !ownConnectedBody.Registered) return;
            var turn = Quaternion.FromToRotation(Vector3.right, ownAxis.Equals(Vector3.zero) ? Vector3.right : ownAxis);
            var point = Vector3.Scale(ownAnchor, owner.TransformUnchecked.lossyScale);
            var joint = new Physx.Joint
            {
                Actor = body.Handle, Other = Physx.None, Pose = new Physx.Pose(point, turn), BreakForce = ownBreakForce, BreakTorque = ownBreakTorque,
                Collide = ownCollision ? 1 : 0,
            };
            var otherPosition = Vector3.zero;
            var otherRotation = Quaternion.identity;
            var otherScale = Vector3.one;
            if (!(ownConnectedBody is null))
            {
                joint.Other = ownConnectedBody.Handle;
                otherPosition = ownConnectedBody.position;
                otherRotation = ownConnectedBody.rotation;
                otherScale = ownConnectedBody.owner.TransformUnchecked.lossyScale;
            }
            var inverseRotation = Quaternion.Inverse(otherRotation);
            var otherAnchor = inverseRotation * (body.position + body.rotation * point - otherPosition);
            if (ownAutoConfigure) ownConnectedAnchor = new Vector3(otherAnchor.x / otherScale.x, otherAnchor.y / otherScale.y, otherAnchor.z / otherScale.z);
            else otherAnchor = Vector3.Scale(ownConnectedAnchor, otherScale);
            joint.OtherPose = new Physx.Pose(otherAnchor, (inverseRotation * body.rotation * turn).normalized);
            Describe(ref joint);
            PhysicsWorld.Flush();
            Handle = Physx.physics_joint_create(PhysicsWorld.Handle, &joint);
            if (Handle == Physx.None) Debug.LogError($"The joint of '{NameImpl}' could not be created: {Physx.Error()}", this);
        }

        internal void Drop()
        {
            if (Handle != Physx.None) Physx.physics_joint_destroy(PhysicsWorld.Handle, Handle);
            Handle = Physx.None;
        }

        internal override void CopyFrom(Component original)
        {
            var other = (Joint)original;
            ownConnectedBody = other.ownConnectedBody;
            ownAnchor = other.ownAnchor;
            ownConnectedAnchor = other.ownConnectedAnchor;
            ownAxis = other.ownAxis;
            ownAutoConfigure = other.ownAutoConfigure;
            ownCollision = other.ownCollision;
            ownBreakForce = other.ownBreakForce;
            ownBreakTorque = other.ownBreakTorque;
        }
    }
}
