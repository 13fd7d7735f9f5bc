using System;
using System.Runtime.InteropServices;
using System.Security;

namespace UnityEngine
{
    /// The parts of ODE's C API in use, in double precision. Quaternions are w, x, y, z; a null body is the static world.
    [SuppressUnmanagedCodeSecurity]
    static unsafe class Ode
    {
        const string Library = "libode.so.8";

        public const int MaxContacts = 4;

        [Flags]
        public enum ContactMode
        {
            Bounce = 0x004,
            SoftErp = 0x008,
            SoftCfm = 0x010,
            ApproximatePyramid = 0x7000,
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct SurfaceParameters
        {
            public ContactMode mode;
            public double mu, mu2, rho, rho2, rhoN, bounce, bounceVelocity, softErp, softCfm, motion1, motion2, motionN, slip1, slip2;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct ContactGeometry
        {
            public fixed double position[4];
            public fixed double normal[4]; // out of geom 2, into geom 1
            public double depth;
            public IntPtr geom1, geom2;
            public int side1, side2;
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct Contact
        {
            public SurfaceParameters surface;
            public ContactGeometry geometry;
            public fixed double frictionDirection[4];
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct JointFeedback
        {
            public fixed double force1[4], torque1[4], force2[4], torque2[4];
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct Mass
        {
            public double mass;
            public fixed double center[4];
            public fixed double inertia[12]; // 3 rows of 4
        }

        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern int dInitODE2(uint flags);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern int dCheckConfiguration([MarshalAs(UnmanagedType.LPStr)] string token);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dRandSetSeed(UIntPtr seed);

        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern IntPtr dWorldCreate();
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dWorldDestroy(IntPtr world);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dWorldSetQuickStepNumIterations(IntPtr world, int count);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dWorldSetContactMaxCorrectingVel(IntPtr world, double velocity);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dWorldSetContactSurfaceLayer(IntPtr world, double depth);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern int dWorldQuickStep(IntPtr world, double step);

        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern IntPtr dBodyCreate(IntPtr world);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dBodyDestroy(IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dBodySetPosition(IntPtr body, double x, double y, double z);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dBodySetQuaternion(IntPtr body, double* q);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dBodySetLinearVel(IntPtr body, double x, double y, double z);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dBodySetAngularVel(IntPtr body, double x, double y, double z);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern double* dBodyGetPosition(IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern double* dBodyGetQuaternion(IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern double* dBodyGetLinearVel(IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern double* dBodyGetAngularVel(IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dBodySetMass(IntPtr body, Mass* mass);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dBodyAddTorque(IntPtr body, double x, double y, double z);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dBodySetKinematic(IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dBodySetDynamic(IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dBodyEnable(IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dBodyDisable(IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern int dBodyIsEnabled(IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dBodySetAutoDisableFlag(IntPtr body, int on);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dBodySetGyroscopicMode(IntPtr body, int on);

        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dMassSetZero(Mass* mass);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dMassSetSphere(Mass* mass, double density, double radius);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dMassSetBox(Mass* mass, double density, double x, double y, double z);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dMassSetCapsule(Mass* mass, double density, int direction, double radius, double length);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dMassAdjust(Mass* mass, double total);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dMassTranslate(Mass* mass, double x, double y, double z);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dMassRotate(Mass* mass, double* rotation);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dMassAdd(Mass* mass, Mass* other);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dRfromQ(double* rotation, double* q);

        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr dCreateSphere(IntPtr space, double radius);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr dCreateBox(IntPtr space, double x, double y, double z);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr dCreateCapsule(IntPtr space, double radius, double length);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dGeomDestroy(IntPtr geom);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dGeomSetBody(IntPtr geom, IntPtr body);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dGeomSetPosition(IntPtr geom, double x, double y, double z);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dGeomSetQuaternion(IntPtr geom, double* q);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dGeomSetOffsetPosition(IntPtr geom, double x, double y, double z);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dGeomSetOffsetQuaternion(IntPtr geom, double* q);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern int dCollide(IntPtr geom1, IntPtr geom2, int flags, ContactGeometry* contacts, int skip);

        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern IntPtr dJointGroupCreate(int unused);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dJointGroupEmpty(IntPtr group);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dJointGroupDestroy(IntPtr group);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr dJointCreateContact(IntPtr world, IntPtr group, Contact* contact);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern IntPtr dJointCreateLMotor(IntPtr world, IntPtr group);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dJointSetLMotorNumAxes(IntPtr joint, int count);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dJointSetLMotorAxis(IntPtr joint, int index, int relativeTo, double x, double y, double z);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dJointSetLMotorParam(IntPtr joint, int parameter, double value);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dJointAttach(IntPtr joint, IntPtr body1, IntPtr body2);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)] public static extern void dJointDestroy(IntPtr joint);
        [DllImport(Library, ExactSpelling = true, CallingConvention = CallingConvention.Cdecl)]
        public static extern void dJointSetFeedback(IntPtr joint, JointFeedback* feedback);
    }
}
