namespace UnityEngine
{
    public struct JointMotor
    {
        /// Degrees per second.
        public float targetVelocity { get; set; }
        /// Newton metres.
        public float force { get; set; }
        public bool freeSpin { get; set; }
    }

    public struct JointLimits
    {
        /// Degrees.
        public float min { get; set; }
        public float max { get; set; }
        public float bounciness { get; set; }
        public float bounceMinVelocity { get; set; }
        public float contactDistance { get; set; }
    }

    public struct JointSpring
    {
        public float spring;
        public float damper;
        /// Degrees.
        public float targetPosition;
    }

    /// Lets a body rotate about an axis through the anchor. Unlike in Unity, the motor also brakes, and the limits do not bounce.
    public class HingeJoint : Joint
    {
        JointMotor ownMotor;
        JointLimits ownLimits;
        JointSpring ownSpring;
        bool ownUseMotor, ownUseLimits, ownUseSpring;

        public JointMotor motor { get => this.Existing().ownMotor; set => Set(ref ownMotor, value); }
        public JointLimits limits { get => this.Existing().ownLimits; set => Set(ref ownLimits, value); }
        public JointSpring spring { get => this.Existing().ownSpring; set => Set(ref ownSpring, value); }
        public bool useMotor { get => this.Existing().ownUseMotor; set => Set(ref ownUseMotor, value); }
        public bool useLimits { get => this.Existing().ownUseLimits; set => Set(ref ownUseLimits, value); }
        public bool useSpring { get => this.Existing().ownUseSpring; set => Set(ref ownUseSpring, value); }

        /// Angular velocity about the axis relative to the connected body, in degrees per second.
        public float velocity
        {
            get
            {
                var relative = Body.angularVelocity - (connectedBody ? connectedBody.angularVelocity : Vector3.zero);
                return Vector3.Dot(relative, Body.rotation * axis.normalized) * Mathf.Rad2Deg;
            }
        }

        internal override void Describe(ref Physx.Joint joint)
        {
            joint.Kind = Physx.JointKind.Hinge;
            if (ownUseLimits && ownLimits.min > ownLimits.max)
                Debug.LogError($"HingeJoint '{NameImpl}' has no limits, because min ({ownLimits.min}) exceeds max ({ownLimits.max}).", this);
            joint.UseLimits = ownUseLimits && ownLimits.min <= ownLimits.max ? 1 : 0;
            joint.Least = Mathf.Clamp(ownLimits.min, -179f, 179f) * Mathf.Deg2Rad;
            joint.Most = Mathf.Clamp(ownLimits.max, -179f, 179f) * Mathf.Deg2Rad;
            joint.UseMotor = ownUseMotor ? 1 : 0;
            joint.MotorVelocity = ownMotor.targetVelocity * Mathf.Deg2Rad;
            joint.MotorForce = Mathf.Max(0f, ownMotor.force);
            if (!ownUseSpring) return;
            joint.Spring = Mathf.Max(0f, ownSpring.spring);
            joint.Damper = Mathf.Max(0f, ownSpring.damper);
            joint.Target = ownSpring.targetPosition * Mathf.Deg2Rad;
        }

        internal override void CopyFrom(Component original)
        {
            base.CopyFrom(original);
            var other = (HingeJoint)original;
            ownMotor = other.ownMotor;
            ownLimits = other.ownLimits;
            ownSpring = other.ownSpring;
            ownUseMotor = other.ownUseMotor;
            ownUseLimits = other.ownUseLimits;
            ownUseSpring = other.ownUseSpring;
        }
    }
}
