using System;
using System.Runtime.InteropServices;

namespace UnityEngine
{
    /// The C interface of the library collektive_physics. Its header, NativePhysics/include/collektive_physics.h, documents it.
    static unsafe class Physx
    {
        public const int Version = 7;
        public const int None = -1;

        const string Library = "collektive_physics";

        public enum Kind
        {
            Sphere = 0,
            Box = 1,
            Capsule = 2,
            Mesh = 3,
        }

        public enum Order
        {
            Pose = 0,
            Target = 1,
            Velocity = 2,
            Spin = 3,
            Force = 4, // + 0 to 3: as ForceMode, acceleration as 3
            Torque = 8,
            Wake = 12,
            Sleep = 13,
            Kinematic = 14,
            Gravity = 15,
            Damping = 16,
            Limits = 17,
            Freeze = 18,
            Mass = 19,
            MassCenter = 20,
            SleepBelow = 21,
            Iterations = 22,
            Detection = 23,
            Inertia = 24,
        }

        public enum Phase
        {
            Enter = 0,
            Stay = 1,
            Exit = 2,
        }

        /// The faces of meshes that rays hit. Without a flag: the front face nearest to the origin.
        [Flags]
        public enum Faces
        {
            Back = 1,
            All = 2,
        }

        [Flags]
        public enum Reports
        {
            None = 0,
            Overlaps = 1,
            Contacts = 2,
        }

        public struct Pose
        {
            public Vector3 Position;
            public Quaternion Rotation;

            public Pose(Vector3 position, Quaternion rotation)
            {
                Position = position;
                Rotation = rotation;
            }
        }

        public struct Geometry
        {
            public Kind Kind;
            public float Radius;
            public Vector3 Half;
            public IntPtr Mesh;
        }

        public struct Material
        {
            public float StaticFriction, DynamicFriction, Bounciness;
            public Combine FrictionCombine, BounceCombine;
        }

        /// How the properties of two materials are combined. The values are PhysX's. If two materials have different modes, the mode with the greater value
        /// applies.
        public enum Combine
        {
            Average = 0,
            Minimum = 1,
            Multiply = 2,
            Maximum = 3,
        }

        public struct Shape
        {
            public Geometry Geometry;
            public Pose Pose;
            public Material Material;
            public uint Identity;
            public int Layer;
            public int Trigger;
            public Reports Reports;
            public CollisionDetectionMode Detection;
        }

        public enum JointKind
        {
            Fixed = 0,
            Hinge = 1,
            Spring = 2,
        }

        public struct Joint
        {
            public JointKind Kind;
            public int Actor, Other;
            public Pose Pose, OtherPose;
            public float BreakForce, BreakTorque;
            public int Collide;
            public int UseLimits, UseMotor;
            public float Least, Most;
            public float MotorVelocity, MotorForce;
            public float Spring, Damper, Target;
        }

        public struct Command
        {
            public int Actor;
            public Order Order;
            public fixed float Value[7];
        }

#pragma warning disable 0649 // the library writes them
        public struct Motion
        {
            public int Step;
            public int Asleep;
            public Pose Pose;
            public Vector3 Velocity, Spin;
        }

        public struct Touch
        {
            public int A, B;
            public Phase Phase;
            public int Trigger;
            public int FirstContact, ContactCount;
            public Vector3 RelativeVelocity;
        }

        public struct Contact
        {
            public Vector3 Point, Normal, Impulse;
            public float Separation;
        }

        public struct Break
        {
            public int Joint;
            public float Force;
        }

        public struct Result
        {
            public Touch* Touches;
            public Contact* Contacts;
            public Break* Broken;
            public int TouchCount, ContactCount, BrokenCount;
        }

        public struct Hit
        {
            public int Shape;
            public int Triangle;
            public Vector3 Point, Normal;
            public float Distance;
        }
#pragma warning restore 0649

        public struct Filter
        {
            public int Layers;
            public int Triggers;
            public Faces Faces;
        }

        public struct RayLine
        {
            public Vector3 Origin, Direction;
            public float Distance;
        }

        public struct Sphere
        {
            public Vector3 Centre;
            public float Radius;
        }

        [DllImport(Library)] public static extern int physics_version();
        [DllImport(Library)] static extern IntPtr physics_error();
        [DllImport(Library)] public static extern IntPtr physics_world_create(int threads);
        [DllImport(Library)] public static extern void physics_world_destroy(IntPtr world);
        [DllImport(Library)] public static extern void physics_ignore_layers(IntPtr world, int* rows);
        [DllImport(Library)] public static extern void physics_ignore_pair(IntPtr world, uint identity, uint other, int shape, int otherShape,
            int ignore);
        [DllImport(Library)] public static extern void physics_improve_friction(IntPtr world, int improved);

        [DllImport(Library)] public static extern int physics_actor_create(IntPtr world, int dynamic, Pose* pose);
        [DllImport(Library)] public static extern void physics_actor_destroy(IntPtr world, int actor);
        [DllImport(Library)] public static extern void physics_mass_center(IntPtr world, int actor, Vector3* center);
        [DllImport(Library)] public static extern void physics_inertia(IntPtr world, int actor, Vector3* diagonal, Quaternion* rotation);

        [DllImport(Library)] public static extern int physics_shape_create(IntPtr world, int actor, Shape* shape);
        [DllImport(Library)] public static extern int physics_shape_change(IntPtr world, int shape, Shape* to);
        [DllImport(Library)] public static extern void physics_shape_destroy(IntPtr world, int shape);
        [DllImport(Library)] public static extern void physics_shape_bounds(IntPtr world, int shape, Vector3* least, Vector3* most);

        [DllImport(Library)] public static extern IntPtr physics_mesh_create(Vector3* points, int pointCount, int* indices, int indexCount, int convex);
        [DllImport(Library)] public static extern void physics_mesh_release(IntPtr mesh);

        [DllImport(Library)] public static extern int physics_joint_create(IntPtr world, Joint* joint);
        [DllImport(Library)] public static extern void physics_joint_destroy(IntPtr world, int joint);

        [DllImport(Library)] public static extern void physics_apply(IntPtr world, Command* commands, int count);
        [DllImport(Library)]
        public static extern int physics_step(IntPtr world, Command* commands, int count, float seconds, Vector3* gravity, int number, Motion* motions,
            Result* result);

        [DllImport(Library)] public static extern void physics_raycast(IntPtr world, RayLine* rays, Filter* filters, int count, Hit* hits);
        [DllImport(Library)] public static extern int physics_raycast_all(IntPtr world, RayLine* ray, Filter* filter, Hit* hits, int capacity);
        [DllImport(Library)] public static extern int physics_raycast_shape(IntPtr world, int shape, RayLine* ray, Hit* hit);
        [DllImport(Library)] public static extern int physics_overlap(IntPtr world, Geometry* geometry, Pose* pose, Filter* filter, int* shapes, int capacity);
        [DllImport(Library)]
        public static extern void physics_begin_overlaps(IntPtr world, Sphere* spheres, Filter* filters, int count, int* shapes, int capacity);
        [DllImport(Library)] public static extern void physics_finish_overlaps(IntPtr world);
        [DllImport(Library)]
        public static extern int physics_sweep(IntPtr world, Geometry* geometry, Pose* pose, Vector3* direction, float distance, Filter* filter, Hit* hits,
            int capacity);
        [DllImport(Library)]
        public static extern int physics_sweep_actor(IntPtr world, int actor, Vector3* direction, float distance, int triggers, Hit* hits, int capacity);
        [DllImport(Library)] public static extern void physics_closest_point(IntPtr world, int shape, Pose* at, Vector3* point, Vector3* closest);
        [DllImport(Library)]
        public static extern int physics_penetration(IntPtr world, int shape, Pose* at, int other, Pose* otherAt, Vector3* direction, float* distance);

        /// Returns the first error since the last call, or an empty string.
        public static string Error()
        {
            var text = physics_error();
            return Marshal.ReadByte(text) == 0 ? "" : Marshal.PtrToStringAnsi(text);
        }
    }
}
