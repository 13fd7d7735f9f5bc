using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace UnityEngine
{
    /// The one physics world: its members in creation order, what moved since the last sync, and the step. Main thread only.
    static unsafe class PhysicsWorld
    {
        public static readonly IgnoredPairs Ignored = new IgnoredPairs();

        static readonly List<Rigidbody> Bodies = new List<Rigidbody>();
        static readonly List<Collider> Colliders = new List<Collider>();
        static readonly List<Transform> Moved = new List<Transform>();
        static readonly ColliderGrid Places = new ColliderGrid();
        static readonly Touches Touching = new Touches();
        static readonly Ode.Contact* Contacts = (Ode.Contact*)Marshal.AllocHGlobal(Ode.MaxContacts * sizeof(Ode.Contact));

        static IntPtr world, contactGroup;
        static bool initialized, stepping;

        public static int Seed;
        public static bool GridStale = true;

        public static IntPtr Handle => world != IntPtr.Zero ? world : Create();

        public static ColliderGrid Grid
        {
            get
            {
                if (GridStale) Places.Build(Colliders);
                GridStale = false;
                return Places;
            }
        }

        static IntPtr Create()
        {
            if (!initialized) Initialize();
            Ode.dRandSetSeed((UIntPtr)(uint)Seed); // QuickStep draws from a global generator
            world = Ode.dWorldCreate();
            contactGroup = Ode.dJointGroupCreate(0);
            Ode.dWorldSetQuickStepNumIterations(world, 20);
            Ode.dWorldSetContactMaxCorrectingVel(world, 5);
            Ode.dWorldSetContactSurfaceLayer(world, 0.001);
            return world;
        }

        static void Initialize()
        {
            try
            {
                Ode.dInitODE2(0);
            }
            catch (DllNotFoundException exception)
            {
                throw new DllNotFoundException(
                    "The physics engine ODE (libode.so.8) is missing: install it, on Debian or Ubuntu with 'apt-get install libode8'.", exception);
            }
            if (Ode.dCheckConfiguration("ODE_double_precision") == 0)
                throw new NotSupportedException(
                    "The installed ODE (libode.so.8) is a single precision build; the headless player needs double precision, as Debian and Ubuntu build it.");
            initialized = true;
        }

        public static void ResetState()
        {
            Bodies.Clear();
            Colliders.Clear();
            Moved.Clear();
            Touching.Clear();
            Ignored.Clear();
            GridStale = true;
            Seed = 0;
            stepping = false;
            Physics.ResetState();
            if (world == IntPtr.Zero) return;
            Ode.dJointGroupDestroy(contactGroup);
            Ode.dWorldDestroy(world);
            world = contactGroup = IntPtr.Zero;
        }

        // ---- Members --------------------------------------------------------------------------------------------------

        public static void Add(Rigidbody body) => Bodies.Add(body);
        public static void Remove(Rigidbody body) => Bodies.Remove(body);

        public static void Add(Collider collider)
        {
            Colliders.Add(collider);
            GridStale = true;
        }

        public static void Remove(Collider collider)
        {
            Colliders.Remove(collider);
            GridStale = true;
        }

        // ---- Transforms -----------------------------------------------------------------------------------------------

        public static void TransformChanged(Transform transform)
        {
            if (transform.awaitsSync) return;
            transform.awaitsSync = true;
            Moved.Add(transform);
        }

        /// Another parent may mean another body.
        public static void HierarchyChanged(Transform transform)
        {
            var parts = transform.owner.physicsParts;
            if (parts != null)
                for (var index = 0; index < parts.Count; index++)
                    if (parts[index] is Collider collider) collider.Attach();
            foreach (var child in transform.children) HierarchyChanged(child);
        }

        public static void SyncTransforms()
        {
            for (var index = 0; index < Moved.Count; index++)
            {
                var transform = Moved[index];
                transform.awaitsSync = false;
                if (!transform.destroyed) Sync(transform);
            }
            Moved.Clear();
        }

        static void Sync(Transform transform)
        {
            var parts = transform.owner.physicsParts;
            if (parts != null)
                for (var index = 0; index < parts.Count; index++)
                {
                    if (parts[index] is Rigidbody body) body.TakePose();
                    else ((Collider)parts[index]).TakePose();
                }
            var children = transform.children;
            for (var index = 0; index < children.Count; index++) Sync(children[index]);
        }

        // ---- Step -----------------------------------------------------------------------------------------------------

        public static void Step(float step)
        {
            if (stepping) throw new InvalidOperationException("A physics step was asked for inside a physics message.");
            SyncTransforms();
            if (step <= 0f) return;
            stepping = true;
            try
            {
                Touching.BeginStep();
                if (Bodies.Count > 0) MoveBodies(step);
                Touching.SendMessages(step);
            }
            finally
            {
                stepping = false;
            }
        }

        static void MoveBodies(float step)
        {
            for (var index = 0; index < Bodies.Count; index++) Bodies[index].BeforeStep(step);
            for (var index = 0; index < Colliders.Count; index++) Colliders[index].RefreshGeom();
            FindTouches();
            Ode.dWorldQuickStep(world, step);
            Ode.dJointGroupEmpty(contactGroup);
            for (var index = 0; index < Bodies.Count; index++) Bodies[index].AfterStep();
        }

        static void FindTouches()
        {
            var grid = Grid;
            foreach (var body in Bodies)
                foreach (var collider in body.Colliders)
                {
                    var isSphere = collider.World.IsSphere;
                    var candidates = isSphere ? grid.InSphere(collider.World.Center, collider.World.Radius) : grid.InBox(collider.Min, collider.Max);
                    for (var index = 0; index < candidates; index++)
                    {
                        var other = grid.Found(index);
                        if (!other.IsStatic && (collider.id >= other.id || ReferenceEquals(other.Body, body))) continue;
                        Examine(collider, other, isSphere);
                    }
                }
        }

        /// `surelyTouch`: the shapes were compared already, not only the boxes around them.
        static void Examine(Collider a, Collider b, bool surelyTouch)
        {
            var trigger = a.isTrigger || b.isTrigger;
            var solid = !trigger && (IsPushable(a) || IsPushable(b));
            var heard = trigger ? HearsTriggers(a) || HearsTriggers(b) : solid && (HearsCollisions(a) || HearsCollisions(b));
            if (!solid && !heard || Ignored.Contains(a, b)) return;
            if (!surelyTouch && b.World.IsSphere)
            {
                if (!a.World.TouchesSphere(b.World.Center, b.World.Radius)) return;
                surelyTouch = true;
            }
            if (trigger)
            {
                Ode.ContactGeometry any;
                if (surelyTouch || Ode.dCollide(a.Geom, b.Geom, 1, &any, sizeof(Ode.ContactGeometry)) > 0) Touching.AddTrigger(a, b);
                return;
            }
            var count = Ode.dCollide(a.Geom, b.Geom, Ode.MaxContacts, &Contacts->geometry, sizeof(Ode.Contact));
            if (count == 0) return;
            var touch = heard ? Touching.AddCollision(a, b) : null;
            var surface = Surface(a.EffectiveMaterial, b.EffectiveMaterial);
            for (var index = 0; index < count; index++)
            {
                Contacts[index].surface = surface;
                var joint = Ode.dJointCreateContact(world, contactGroup, &Contacts[index]);
                Ode.dJointAttach(joint, a.IsStatic ? IntPtr.Zero : a.Body.Handle, b.IsStatic ? IntPtr.Zero : b.Body.Handle);
                if (touch != null) Ode.dJointSetFeedback(joint, Touching.AddContact(touch, &Contacts[index].geometry));
            }
        }

        static Ode.SurfaceParameters Surface(PhysicsMaterial a, PhysicsMaterial b)
        {
            const float slowestBounce = 2f; // m/s: Unity's default bounce threshold
            var bounce = PhysicsMaterial.CombinedBounciness(a, b);
            return new Ode.SurfaceParameters
            {
                mode = Ode.ContactMode.ApproximatePyramid | Ode.ContactMode.SoftErp | Ode.ContactMode.SoftCfm | (bounce > 0f ? Ode.ContactMode.Bounce : 0),
                mu = PhysicsMaterial.CombinedFriction(a, b),
                bounce = bounce,
                bounceVelocity = slowestBounce,
                softErp = 0.2,
                softCfm = 1e-5,
            };
        }

        static bool IsPushable(Collider collider) => !collider.IsStatic && !collider.Body.isKinematic;
        static bool HearsTriggers(Collider collider) =>
            (collider.owner.hears & TouchMessages.Triggers) != 0 || !collider.IsStatic && (collider.Body.owner.hears & TouchMessages.Triggers) != 0;
        static bool HearsCollisions(Collider collider) => ((collider.IsStatic ? collider.owner : collider.Body.owner).hears & TouchMessages.Collisions) != 0;
    }
}
