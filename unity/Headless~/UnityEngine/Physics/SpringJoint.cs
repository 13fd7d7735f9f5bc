namespace UnityEngine
{
    public class SpringJoint : Joint
    {
        float ownSpring = 10f, ownDamper = 0.2f, ownMinDistance, ownMaxDistance, ownTolerance = 0.025f;

        /// Newtons per metre.
        public float spring { get => this.Existing().ownSpring; set => Set(ref ownSpring, value); }
        public float damper { get => this.Existing().ownDamper; set => Set(ref ownDamper, value); }
        public float minDistance { get => this.Existing().ownMinDistance; set => Set(ref ownMinDistance, value); }
        public float maxDistance { get => this.Existing().ownMaxDistance; set => Set(ref ownMaxDistance, value); }
        public float tolerance { get => this.Existing().ownTolerance; set => Set(ref ownTolerance, value); }

        internal override void Describe(ref Physx.Joint joint)
        {
            joint.Kind = Physx.JointKind.Spring;
            joint.Spring = Mathf.Max(0f, ownSpring);
            joint.Damper = Mathf.Max(0f, ownDamper);
            joint.Least = Mathf.Max(0f, ownMinDistance);
            joint.Most = Mathf.Max(joint.Least, ownMaxDistance);
            joint.Target = Mathf.Max(0f, ownTolerance);
        }

        internal override void CopyFrom(Component original)
        {
            base.CopyFrom(original);
            var other = (SpringJoint)original;
            ownSpring = other.ownSpring;
            ownDamper = other.ownDamper;
            ownMinDistance = other.ownMinDistance;
            ownMaxDistance = other.ownMaxDistance;
            ownTolerance = other.ownTolerance;
        }
    }
}
