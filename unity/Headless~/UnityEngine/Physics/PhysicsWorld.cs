using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace UnityEngine
{
    /// The physics world. It collects moved transforms and commands for PhysX, and steps PhysX. Use it from the main thread only.
    static unsafe class PhysicsWorld
    {
        public static readonly IgnoredPairs Ignored = new IgnoredPairs();

        static readonly List<Transform> Moved = new List<Transform>();
        static readonly List<Joint> Joints = new List<Joint>();
        static readonly List<Rigidbody> Unpublished = new List<Rigidbody>();
        static readonly List<TerrainCollider> Terrains = new List<TerrainCollider>();
        static readonly Touches Touching = new Touches();

        static readonly List<Rigidbody> Nested = new List<Rigidbody>(); // their transforms have parents
        static Collider[] colliders = new Collider[64]; // by PhysX's handle of the shape
        static Physx.Command* commands; // native: read by PhysX, kept until the process ends
        static int commandCount, commandCapacity;
        static int motionCapacity;
        static IntPtr world;

        /// Whether a step or its messages are not finished.
        public static bool IsStepping { get; private set; }

        static int materialChanges, terrainChanges;

        /// Motions of the bodies, indexed by PhysX's handle of the body. PhysX writes them during steps, and scripts between steps. The native memory is
        /// kept until the process ends.
        public static Physx.Motion* Motions { get; private set; }

        /// Number of steps of this world so far.
        public static int StepCount { get; private set; }

        /// Number of threads for the next world. Results do not depend on it.
        public static int Threads = 1;

        /// The world. Running queries are completed before it is returned.
        public static IntPtr Handle
        {
            get
            {
                if (OverlapBatch.IsRunning) OverlapBatch.Finish();
                return world != IntPtr.Zero ? world : Create();
            }
        }

        static IntPtr Create()
        {
            try
            {
                if (Physx.physics_version() != Physx.Version)
                    throw new NotSupportedException("libcollektive_physics.so does not match this player: run ./collektive clean and build again.");
            }
            catch (DllNotFoundException exception)
            {
                throw new DllNotFoundException("The physics engine (libcollektive_physics.so) is missing: any ./collektive command that runs scenes builds it.",
                    exception);
            }
            world = Physx.physics_world_create(Math.Max(1, Threads));
            if (world == IntPtr.Zero) throw new OutOfMemoryException("PhysX could not create a world: " + Physx.Error());
            return world;
        }

        /// Resets the physics world. All objects must have been destroyed.
        public static void ResetState()
        {
            OverlapBatch.Finish();
            QueryJobs.ResetState();
            Moved.Clear();
            Unpublished.Clear();
            Nested.Clear();
            Touching.Clear();
            Ignored.Clear();
            commandCount = 0;
            StepCount = 0;
            IsStepping = false;
            Physics.ResetState();
            if (world != IntPtr.Zero) Physx.physics_world_destroy(world);
            world = IntPtr.Zero;
        }

        // ---- Members --------------------------------------------------------------------------------------------------

        /// Allocates memory for the motion of the body.
        public static void Add(Rigidbody body)
        {
            if (body.Handle >= motionCapacity) Motions = Longer(Motions, motionCapacity = Math.Max(1024, 2 * body.Handle));
        }

        public static void Add(Joint joint) => Joints.Add(joint);
        public static void Remove(Joint joint) => Joints.Remove(joint);

        public static void Add(TerrainCollider terrain) => Terrains.Add(terrain);
        public static void Remove(TerrainCollider terrain) => Terrains.Remove(terrain);

        /// Adds a body, and creates the joints that wait for it.
        public static void Connect(Rigidbody body)
        {
            foreach (var joint in Joints)
                if (joint.Connects(body)) joint.Refresh();
        }

        /// Removes a body with PhysX's joints.
        public static void Disconnect(Rigidbody body)
        {
            foreach (var joint in Joints)
                if (joint.Connects(body)) joint.Drop();
        }

        public static void Remove(Rigidbody body)
        {
            Unpublished.Remove(body);
            SetNested(body, false);
        }

        public static void Add(Collider collider)
        {
            if (collider.Handle >= colliders.Length) Array.Resize(ref colliders, 2 * collider.Handle);
            colliders[collider.Handle] = collider;
        }

        public static void Remove(Collider collider) => colliders[collider.Handle] = null;

        public static Collider ColliderOf(int shape) => shape == Physx.None ? null : colliders[shape];

        /// Records whether the body's transform has a parent.
        public static void SetNested(Rigidbody body, bool nested)
        {
            if (nested == body.IndexInNested >= 0) return;
            if (nested)
            {
                body.IndexInNested = Nested.Count;
                Nested.Add(body);
                return;
            }
            var last = Nested[Nested.Count - 1];
            Nested[last.IndexInNested = body.IndexInNested] = last;
            Nested.RemoveAt(Nested.Count - 1);
            body.IndexInNested = -1;
        }

        /// Requests that the next step moves the body's transform, even if PhysX does not move the body.
        public static void PublishAfterStep(Rigidbody body) => Unpublished.Add(body);

        // ---- Commands -------------------------------------------------------------------------------------------------

        public static void Order(int actor, Physx.Order order, Vector3 value)
        {
            var command = NextCommand(actor, order);
            command->Value[0] = value.x;
            command->Value[1] = value.y;
            command->Value[2] = value.z;
        }

        public static void Order(int actor, Physx.Order order, Vector3 value, Quaternion rotation)
        {
            var command = NextCommand(actor, order);
            command->Value[0] = value.x;
            command->Value[1] = value.y;
            command->Value[2] = value.z;
            command->Value[3] = rotation.x;
            command->Value[4] = rotation.y;
            command->Value[5] = rotation.z;
            command->Value[6] = rotation.w;
        }

        static Physx.Command* NextCommand(int actor, Physx.Order order)
        {
            if (commandCount == commandCapacity)
                commands = Longer(commands, commandCapacity = Math.Max(1024, 2 * commandCapacity));
            var command = commands + commandCount++;
            command->Actor = actor;
            command->Order = order;
            return command;
        }

        static T* Longer<T>(T* memory, int length) where T : unmanaged
        {
            var size = (IntPtr)((long)length * sizeof(T));
            return (T*)(memory == null ? Marshal.AllocHGlobal(size) : Marshal.ReAllocHGlobal((IntPtr)memory, size));
        }

        /// Sends pending changes to PhysX before a query.
        public static void Flush()
        {
            RefreshTerrains();
            if (commandCount == 0) return;
            Physx.physics_apply(Handle, commands, commandCount);
            commandCount = 0;
        }

        // ---- Transforms -----------------------------------------------------------------------------------------------

        public static void TransformChanged(Transform transform, bool isPose = true)
        {
            transform.awaitsPoseSync |= isPose;
            if (transform.awaitsSync) return;
            transform.awaitsSync = true;
            Moved.Add(transform);
        }

        /// Records a change of parents, because a new parent can change the body of a collider.
        public static void HierarchyChanged(Transform transform)
        {
            var parts = transform.owner.physicsParts;
            if (parts != null)
                for (var index = 0; index < parts.Count; index++)
                {
                    if (parts[index] is Collider collider) collider.Attach();
                    else SetNested((Rigidbody)parts[index], !(transform.parentOrNull is null));
                }
            foreach (var child in transform.children) HierarchyChanged(child);
        }

        public static void SyncTransforms()
        {
            for (var index = 0; index < Moved.Count; index++)
            {
                var transform = Moved[index];
                var isPose = transform.awaitsPoseSync;
                transform.awaitsSync = transform.awaitsPoseSync = false;
                if (!transform.destroyed) Sync(transform, isPose);
            }
            Moved.Clear();
        }

        /// Another scale must not undo a pose that a script set for the body, but moves the children.
        static void Sync(Transform transform, bool isPose)
        {
            var parts = transform.owner.physicsParts;
            if (parts != null)
                for (var index = 0; index < parts.Count; index++)
                {
                    if (parts[index] is Collider collider) collider.TakePose();
                    else if (isPose) ((Rigidbody)parts[index]).TakePose();
                }
            var children = transform.children;
            for (var index = 0; index < children.Count; index++) Sync(children[index], true);
        }

        // ---- Step -----------------------------------------------------------------------------------------------------

        public static void Step(float step)
        {
            if (IsStepping) throw new InvalidOperationException("Physics.Simulate was called in a message such as OnCollisionEnter: call it elsewhere.");
            SyncTransforms();
            if (step <= 0f) return;
            RefreshMaterials();
            RefreshTerrains();
            IsStepping = true;
            try
            {
                var gravity = Physics.gravity;
                Physx.Result result;
                var count = commandCount;
                commandCount = 0;
                var done = Physx.physics_step(Handle, commands, count, step, &gravity, StepCount + 1, Motions, &result);
                StepCount++;
                if (done == 0) throw new InvalidOperationException(Physx.Error());
                // Most transforms are updated from their bodies only when they are read, which saves work between the steps of a tick. Transforms with
                // parents must be updated before their parents move.
                foreach (var body in Nested) body.UpdateTransform();
                foreach (var body in Unpublished) body.Publish();
                Unpublished.Clear();
                LogErrors();
                var broken = BrokenJoints(result);
                Touching.Send(result);
                if (broken != null)
                    foreach (var (joint, force) in broken) Break(joint, force);
            }
            finally
            {
                IsStepping = false;
            }
        }

        /// Returns the joints that broke in a step with their forces, or null if none broke.
        static List<(Joint, float)> BrokenJoints(in Physx.Result result)
        {
            List<(Joint, float)> broken = null;
            for (var index = 0; index < result.BrokenCount; index++)
                foreach (var joint in Joints)
                {
                    if (joint.Handle != result.Broken[index].Joint) continue;
                    joint.Handle = Physx.None;
                    (broken = broken ?? new List<(Joint, float)>()).Add((joint, result.Broken[index].Force));
                }
            return broken;
        }

        static void Break(Joint joint, float force)
        {
            if (!joint) return;
            var target = joint.owner;
            for (var index = 0; index < target.components.Count; index++)
                if (target.components[index] is MonoBehaviour script && script.HasAwoken) Messages.Send(script.messages.OnJointBreak, script, force);
            Object.Destroy(joint);
        }

        static void RefreshMaterials()
        {
            if (materialChanges == PhysicsMaterial.Changes) return;
            materialChanges = PhysicsMaterial.Changes;
            foreach (var collider in colliders) collider?.Refresh();
        }

        /// As in Unity, colliders follow their terrains at once.
        static void RefreshTerrains()
        {
            if (terrainChanges == TerrainData.Changes) return;
            terrainChanges = TerrainData.Changes;
            foreach (var terrain in Terrains) terrain.Refresh();
        }

        static void LogErrors()
        {
            var error = Physx.Error();
            if (error.Length > 0) Debug.LogError(error);
        }
    }
}
