using System;
using System.Runtime.InteropServices;
using Unity.Collections;

namespace UnityEngine
{
    /// A batch of sphere overlaps that runs on other physics threads while the main thread continues. Only one batch runs at a time. Any other physics
    /// call first waits for it to end.
    static unsafe class OverlapBatch
    {
        static Physx.Sphere* spheres; // native, as the next two: kept until the process ends
        static Physx.Filter* filters;
        static int* shapes;
        static int sphereCapacity, shapeCapacity;
        static NativeArray<ColliderHit> results;
        static int count, hitsPerSphere;
        static IntPtr world;

        public static bool IsRunning { get; private set; }

        public static bool Uses(object memory) => IsRunning && results.Memory == memory;

        /// Starts a batch. Each sphere has `maxHits` results, which receive the colliders that touch it. With fewer colliders, null follows the last one.
        public static void Begin(Span<OverlapSphereCommand> commands, NativeArray<ColliderHit> hits, int maxHits)
        {
            PhysicsWorld.Flush();
            world = PhysicsWorld.Handle;
            count = commands.Length;
            hitsPerSphere = maxHits;
            results = hits;
            Reserve();
            for (var index = 0; index < count; index++)
            {
                ref var command = ref commands[index];
                var centre = command.point;
                var radius = Mathf.Abs(command.radius);
                var sum = centre.x + centre.y + centre.z + radius;
                // A sphere with NaN finds no colliders.
                var isNumber = sum - sum == 0f;
                spheres[index] = isNumber ? new Physx.Sphere { Centre = centre, Radius = radius } : default;
                filters[index] = isNumber ? Queries.Filter(command.queryParameters.layerMask, command.queryParameters.hitTriggers) : default;
            }
            Physx.physics_begin_overlaps(world, spheres, filters, count, shapes, hitsPerSphere);
            IsRunning = true;
        }

        public static void Finish()
        {
            if (!IsRunning) return;
            IsRunning = false;
            Physx.physics_finish_overlaps(world);
            var hits = results.AsSpan();
            results = default;
            for (var first = 0; first < count * hitsPerSphere; first += hitsPerSphere)
                for (var index = first; index < first + hitsPerSphere; index++)
                {
                    var shape = shapes[index];
                    hits[index].collider = PhysicsWorld.ColliderOf(shape);
                    if (shape == Physx.None) break;
                }
        }

        static void Reserve()
        {
            if (count > sphereCapacity)
            {
                sphereCapacity = Math.Max(1024, 2 * count);
                spheres = (Physx.Sphere*)Longer(spheres, sphereCapacity, sizeof(Physx.Sphere));
                filters = (Physx.Filter*)Longer(filters, sphereCapacity, sizeof(Physx.Filter));
            }
            if (count * hitsPerSphere <= shapeCapacity) return;
            shapeCapacity = Math.Max(1024, 2 * count * hitsPerSphere);
            shapes = (int*)Longer(shapes, shapeCapacity, sizeof(int));
        }

        static void* Longer(void* memory, int length, int size)
        {
            if (memory != null) Marshal.FreeHGlobal((IntPtr)memory);
            return (void*)Marshal.AllocHGlobal((IntPtr)((long)length * size));
        }
    }
}
