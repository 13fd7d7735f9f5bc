using System;
using System.Collections.Generic;
using Collektive.Bridge;
using gradientascent;
using org.collektive.schema;

namespace Collektive.Headless.Bench
{
    /// <summary>
    /// The benchmark's world: nodes on a grid with 1 m spacing, as square as possible, each linked to its (up to) eight neighbours. The Kotlin side builds the
    /// same world.
    /// </summary>
    internal sealed class GridWorld
    {
        /// <summary>Every fourth node senses one obstacle.</summary>
        private const int ObstacleEvery = 4;

        private static readonly Vector3Value Obstacle = new Vector3Value { X = 0.4f, Y = 0, Z = 0.3f };

        private readonly int width;
        private readonly Vector3Value[] positions;

        internal GridWorld(int size)
        {
            Size = size;
            width = (int)Math.Ceiling(Math.Sqrt(size));
            positions = new Vector3Value[size];
            for (var node = 0; node < size; node++) positions[node] = new Vector3Value { X = node % width, Y = 0, Z = node / width };
        }

        internal int Size { get; }

        /// <summary>Requests all nodes and links.</summary>
        internal void AddTo(StepRequest request)
        {
            for (var node = 0; node < Size; node++) request.AddNode(node, null, null);
            for (var to = 0; to < Size; to++)
            {
                for (var dz = -1; dz <= 1; dz++)
                {
                    for (var dx = -1; dx <= 1; dx++) AddLink(request, to, dx, dz);
                }
            }
        }

        internal void RemoveFrom(StepRequest request)
        {
            for (var node = 0; node < Size; node++) request.RemoveNode(node);
        }

        /// <summary>Makes all nodes due, with their sensor data for a tick.</summary>
        internal void Sense(StepRequest request, long tick)
        {
            request.ClearDue();
            request.Sensors.EnsureCapacity(Size);
            for (var node = 0; node < Size; node++) Sense(request, node, node, tick);
        }

        /// <summary>Makes one node due. Its sensor data is element <paramref name="index"/>.</summary>
        internal void Sense(StepRequest request, int node, int index, long tick)
        {
            var sensors = (SensorBuffer<SensorData>)request.Sensors;
            sensors.Clear(index);
            var data = sensors.Items[index];
            data.Intensity = (node * 37 + (int)(tick % 64)) % 101;
            data.Position = positions[node];
            if (node % ObstacleEvery == 0) data.Obstacles.Add(Obstacle);
            request.AddDue(node);
        }

        /// <summary>Reads all answers and returns their sum, which prevents dead-code elimination.</summary>
        internal static float Act(StepAnswer answer)
        {
            var actuators = (ActuatorBuffer<ActuatorData>)answer.Actuators;
            var sum = 0f;
            for (var i = 0; i < actuators.Count; i++)
            {
                var target = actuators[i].Target;
                sum += target.X + target.Z;
            }
            return sum;
        }

        private void AddLink(StepRequest request, int to, int dx, int dz)
        {
            var column = to % width + dx;
            var from = (to / width + dz) * width + column;
            if (from == to || column < 0 || column >= width || from < 0 || from >= Size) return;
            request.SetLink(new LinkRecord { From = from, To = to, Length = (float)Math.Sqrt(dx * dx + dz * dz) });
        }
    }
}
