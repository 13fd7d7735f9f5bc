using System;
using System.Runtime.InteropServices;
using Unity.Collections;

namespace UnityEngine
{
    /// A batch of sphere overlaps that runs on the other physics threads while the main thread continues. Only one runs at a time. Any other
    /// request to physics completes it first.
    static unsafe class OverlapBatch
    {
        static Physx.Sphere* spheres; // native, as the next two: kept until the process ends
        static Physx.Filter* filters;
        static int* shapes;
        static int sphereCapacity, shapeCapacity;
        static NativeArray<ColliderHit> results;
        static int count, places;
        static IntPtr world;

        public static bool IsRunning { get; private set; }

        /// Writes the colliders that touch each sphere to its part of the results, up to its capacity, followed by null.
        public static void Begin(Span<OverlapSphereCommand> commands, NativeArray<ColliderHit> hits, int placesOfEach)
        {
            PhysicsWorld.Flush();
            world = PhysicsWorld.Handle;
            count = commands.Length;
            places = placesOfEach;
            results = hits;
            Reserve();
            for (var index = 0; index < count; index++)
            {
                ref var command = ref commands[index];
                var centre = command.point;
                var radius = Mathf.Abs(command.radius);
                var sum = centre.x + centre.y + centre.z + radius;
                // NaN finds nothing.
                var isNumber = sum - sum == 0f;
                spheres[index] = isNumber ? new Physx.Sphere { Centre = centre, Radius = radius } : default;
                filters[index] = isNumber ? Queries.Filter(command.queryParameters.layerMask, command.queryParameters.hitTriggers) : default;
            }
            Physx.physics_begin_overlaps(world, spheres, filters, count, shapes, places);
            IsRunning = true;
        }

        public static void Finish()
        {
            if (!IsRunning) return;
            IsRunning = false;
            Physx.physics_finish_overlaps(world);
            var hits = results.AsSpan();
            results = default;
            for (var first = 0; first < count * places; first += places)
                for (var place = first; place < first + places; place++)
                {
                    var shape = shapes[place];
                    hits[place].collider = PhysicsWorld.ColliderOf(shape);
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
            if (count * places <= shapeCapacity) return;
            shapeCapacity = Math.Max(1024, 2 * count * places);
            shapes = (int*)Longer(shapes, shapeCapacity, sizeof(int));
        }

        static void* Longer(void* memory, int length, int size)
        {
            if (memory != null) Marshal.FreeHGlobal((IntPtr)memory);
            return (void*)Marshal.AllocHGlobal((IntPtr)((long)length * size));
        }
    }
}
