using System;
using System.Collections.Generic;

namespace UnityEngine
{
    /// One ODE body. Its position is the centre of mass.
    sealed unsafe class OdeBody
    {
        const double Immovable = 1e20; // moment of inertia about a frozen axis, kg m2
        const int ParamVel = 2, ParamFMax = 5, ParamGroup = 0x100;

        public readonly IntPtr Handle;
        readonly IntPtr world;
        // ODE's own state: these addresses stay valid as long as the body.
        readonly double* position, rotation, velocity, spin;
        IntPtr rails; // the joint that holds frozen axes, or zero

        public OdeBody(IntPtr world)
        {
            this.world = world;
            Handle = Ode.dBodyCreate(world);
            Ode.dBodySetAutoDisableFlag(Handle, 0);
            Ode.dBodySetGyroscopicMode(Handle, 0);
            position = Ode.dBodyGetPosition(Handle);
            rotation = Ode.dBodyGetQuaternion(Handle);
            velocity = Ode.dBodyGetLinearVel(Handle);
            spin = Ode.dBodyGetAngularVel(Handle);
        }

        public Vector3 Position => new Vector3((float)position[0], (float)position[1], (float)position[2]);
        public Quaternion Rotation => new Quaternion((float)rotation[1], (float)rotation[2], (float)rotation[3], (float)rotation[0]);
        public Vector3 Velocity => new Vector3((float)velocity[0], (float)velocity[1], (float)velocity[2]);
        public Vector3 Spin => new Vector3((float)spin[0], (float)spin[1], (float)spin[2]);
        public bool Enabled => Ode.dBodyIsEnabled(Handle) != 0;

        public void SetEnabled(bool enabled)
        {
            if (enabled) Ode.dBodyEnable(Handle);
            else Ode.dBodyDisable(Handle);
        }

        public void SetPose(Vector3 centerOfMass, Quaternion turn)
        {
            var q = stackalloc double[4] { turn.w, turn.x, turn.y, turn.z };
            Ode.dBodySetPosition(Handle, centerOfMass.x, centerOfMass.y, centerOfMass.z);
            Ode.dBodySetQuaternion(Handle, q);
        }

        public void SetVelocity(Vector3 linear, Vector3 angular)
        {
            Ode.dBodySetLinearVel(Handle, linear.x, linear.y, linear.z);
            Ode.dBodySetAngularVel(Handle, angular.x, angular.y, angular.z);
        }

        public void AddTorque(Vector3 torque) => Ode.dBodyAddTorque(Handle, torque.x, torque.y, torque.z);

        /// Spreads the mass evenly over the solid colliders; returns its centre in the body's frame.
        public Vector3 SetMass(float total, List<Collider> colliders, RigidbodyConstraints constraints, bool kinematic)
        {
            Ode.Mass mass;
            Ode.dMassSetZero(&mass);
            foreach (var collider in colliders)
                if (!collider.isTrigger) Add(collider.Local, &mass);
            if (mass.mass <= 0) Ode.dMassSetSphere(&mass, 1, 0.5);
            Ode.dMassAdjust(&mass, total);
            var center = new Vector3((float)mass.center[0], (float)mass.center[1], (float)mass.center[2]);
            Ode.dMassTranslate(&mass, -mass.center[0], -mass.center[1], -mass.center[2]);
            mass.center[0] = mass.center[1] = mass.center[2] = 0; // what rounding left, which ODE would refuse
            FreezeAxis(&mass, 0, constraints & RigidbodyConstraints.FreezeRotationX);
            FreezeAxis(&mass, 1, constraints & RigidbodyConstraints.FreezeRotationY);
            FreezeAxis(&mass, 2, constraints & RigidbodyConstraints.FreezeRotationZ);
            Ode.dBodySetDynamic(Handle);
            Ode.dBodySetMass(Handle, &mass);
            if (kinematic) Ode.dBodySetKinematic(Handle);
            SetRails(kinematic ? RigidbodyConstraints.None : constraints & RigidbodyConstraints.FreezePosition);
            return center;
        }

        static void Add(Shape shape, Ode.Mass* total)
        {
            Ode.Mass part;
            if (shape.IsSphere) Ode.dMassSetSphere(&part, 1, shape.Radius);
            else if (shape.IsCapsule) Ode.dMassSetCapsule(&part, 1, 3, shape.Radius, 2f * shape.Half.z);
            else Ode.dMassSetBox(&part, 1, 2f * shape.Half.x, 2f * shape.Half.y, 2f * shape.Half.z);
            var q = stackalloc double[4] { shape.Rotation.w, shape.Rotation.x, shape.Rotation.y, shape.Rotation.z };
            var matrix = stackalloc double[12];
            Ode.dRfromQ(matrix, q);
            Ode.dMassRotate(&part, matrix);
            Ode.dMassTranslate(&part, shape.Center.x, shape.Center.y, shape.Center.z);
            Ode.dMassAdd(total, &part);
        }

        static void FreezeAxis(Ode.Mass* mass, int axis, RigidbodyConstraints frozen)
        {
            if (frozen == RigidbodyConstraints.None) return;
            for (var other = 0; other < 3; other++) mass->inertia[axis * 4 + other] = mass->inertia[other * 4 + axis] = 0;
            mass->inertia[axis * 4 + axis] = Immovable;
        }

        /// Frozen world axes as motors that hold speed 0 with any force, so that contacts feel an infinite mass there.
        void SetRails(RigidbodyConstraints frozen)
        {
            if (rails != IntPtr.Zero) Ode.dJointDestroy(rails);
            rails = IntPtr.Zero;
            if (frozen == RigidbodyConstraints.None) return;
            rails = Ode.dJointCreateLMotor(world, IntPtr.Zero);
            Ode.dJointAttach(rails, Handle, IntPtr.Zero);
            var count = 0;
            if ((frozen & RigidbodyConstraints.FreezePositionX) != 0) AddRail(count++, 1, 0, 0);
            if ((frozen & RigidbodyConstraints.FreezePositionY) != 0) AddRail(count++, 0, 1, 0);
            if ((frozen & RigidbodyConstraints.FreezePositionZ) != 0) AddRail(count++, 0, 0, 1);
            Ode.dJointSetLMotorNumAxes(rails, count);
        }

        void AddRail(int index, double x, double y, double z)
        {
            Ode.dJointSetLMotorNumAxes(rails, index + 1);
            Ode.dJointSetLMotorAxis(rails, index, 0, x, y, z);
            Ode.dJointSetLMotorParam(rails, ParamGroup * index + ParamVel, 0);
            Ode.dJointSetLMotorParam(rails, ParamGroup * index + ParamFMax, double.PositiveInfinity);
        }

        public void Destroy()
        {
            if (rails != IntPtr.Zero) Ode.dJointDestroy(rails);
            Ode.dBodyDestroy(Handle);
        }
    }
}
