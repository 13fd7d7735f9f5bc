namespace UnityEngine
{
    public class FixedJoint : Joint
    {
        internal override void Describe(ref Physx.Joint joint) => joint.Kind = Physx.JointKind.Fixed;
    }
}
