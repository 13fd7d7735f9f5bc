namespace UnityEngine
{
    /// Connects the object's body to another body or to the world, in the poses that the bodies have when the joint becomes active, or its anchors, axis or
    /// connected body change.
    [RequireComponent(typeof(Rigidbody))]
    public abstract class Joint : Component
    {
        Rigidbody ownConnectedBody;
        Vector3 ownAnchor, ownConnectedAnchor, ownAxis = Vector3.right;
        bool ownAutoConfigure = true, ownCollision;
        float ownBreakForce = Mathf.Infinity, ownBreakTorque = Mathf.Infinity;

        internal int Handle = Physx.None;
        bool active;
        (Physx.Pose Own, Physx.Pose Other)? frames; // of the joint in the two bodies; null before they are connected

        public Rigidbody connectedBody { get => this.Existing().ownConnectedBody; set => Reconnect(ref ownConnectedBody, value); }
        /// Axis of a hinge in the body's frame.
        public Vector3 axis { get => this.Existing().ownAxis; set => Reconnect(ref ownAxis, value); }
        public Vector3 anchor { get => this.Existing().ownAnchor; set => Reconnect(ref ownAnchor, value); }

        /// Anchor in the frame of the connected body or of the world.
        public Vector3 connectedAnchor
        {
            get => this.Existing().ownConnectedAnchor;
            set
            {
                ownAutoConfigure = false;
                Reconnect(ref ownConnectedAnchor, value);
            }
        }

        /// Whether the connected anchor is computed from the anchor.
        public bool autoConfigureConnectedAnchor { get => this.Existing().ownAutoConfigure; set => Reconnect(ref ownAutoConfigure, value); }

        /// Force in newtons above which `OnJointBreak` is sent and the joint is destroyed.
        public float breakForce { get => this.Existing().ownBreakForce; set => Set(ref ownBreakForce, value); }
        public float breakTorque { get => this.Existing().ownBreakTorque; set => Set(ref ownBreakTorque, value); }
        public bool enableCollision { get => this.Existing().ownCollision; set => Set(ref ownCollision, value); }

        internal Rigidbody Body => owner.GetComponent<Rigidbody>();

        internal abstract void Describe(ref Physx.Joint joint);

        internal void Set<T>(ref T field, T value)
        {
            ThrowIfDestroyed();
            field = value;
            Refresh();
        }

        void Reconnect<T>(ref T field, T value)
        {
            frames = null;
            Set(ref field, value);
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
            Release();
            var body = Body;
            if (body is null || !body.Registered || !(ownConnectedBody is null) && !ownConnectedBody.Registered) return;
            if (frames == null) frames = Frames(body);
            var joint = new Physx.Joint
            {
                Actor = body.Handle, Other = ownConnectedBody is null ? Physx.None : ownConnectedBody.Handle, Pose = frames.Value.Own,
                OtherPose = frames.Value.Other, BreakForce = ownBreakForce, BreakTorque = ownBreakTorque, Collide = ownCollision ? 1 : 0,
            };
            Describe(ref joint);
            PhysicsWorld.Flush();
            Handle = Physx.physics_joint_create(PhysicsWorld.Handle, &joint);
            if (Handle == Physx.None) Debug.LogError($"The joint of '{NameImpl}' could not be created: {Physx.Error()}", this);
        }

        /// Returns the frames that connect the bodies in their present poses.
        (Physx.Pose, Physx.Pose) Frames(Rigidbody body)
        {
            var turn = Quaternion.FromToRotation(Vector3.right, ownAxis.Equals(Vector3.zero) ? Vector3.right : ownAxis);
            var point = Vector3.Scale(ownAnchor, owner.TransformUnchecked.lossyScale);
            var pose = body.NextPose;
            var otherPose = new Physx.Pose(Vector3.zero, Quaternion.identity);
            var otherScale = Vector3.one;
            if (!(ownConnectedBody is null))
            {
                otherPose = ownConnectedBody.NextPose;
                otherScale = ownConnectedBody.owner.TransformUnchecked.lossyScale;
            }
            var inverseRotation = Quaternion.Inverse(otherPose.Rotation);
            var otherAnchor = inverseRotation * (pose.Position + pose.Rotation * point - otherPose.Position);
            if (ownAutoConfigure) ownConnectedAnchor = new Vector3(otherAnchor.x / otherScale.x, otherAnchor.y / otherScale.y, otherAnchor.z / otherScale.z);
            else otherAnchor = Vector3.Scale(ownConnectedAnchor, otherScale);
            return (new Physx.Pose(point, turn), new Physx.Pose(otherAnchor, (inverseRotation * pose.Rotation * turn).normalized));
        }

        /// Disconnects the bodies.
        internal void Drop()
        {
            Release();
            frames = null;
        }

        void Release()
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
