using System;
using Collektive.Bridge;
using Collektive.Headless;
using Collektive.Unity;
using standard;
using UnityEngine;

namespace Collektive.Standard
{
    /// <summary>Writes all sensor data except the velocity.</summary>
    public sealed class StandardSensor : Sensor<SensorData>
    {
        // Serialized, so that copies of a node keep it.
        [SerializeField]
        internal StandardScene Scene;

        protected override void Sense(ref SensorData data)
        {
            data.Position = Node.Position;
            data.Time = SimulationManager.Current.SimulatedTime;
            data.Random = Node.Random.NextDouble();
            data.Sets = Scene.SetsOf(Node.Id);
            data.Source = Scene.IsSource(data.Sets);
            data.Reading = Scene.ReadingOf(Node);
        }
    }

    /// <summary>Writes the node's velocity to the sensor data.</summary>
    public sealed class StandardVelocity : VelocitySensor<SensorData>
    {
        protected override void Write(ref SensorData data, Vector3 velocity) => data.Velocity = velocity;
    }

    /// <summary>Moves the node's body at the program's velocity.</summary>
    public sealed class VelocityActuator : SetVelocityActuator<ActuatorData>
    {
        protected override Vector3 Read(ActuatorData data) => data.Velocity;
    }

    /// <summary>Moves the node's body to the program's target at its present height, because bodies move only horizontally.</summary>
    public sealed class TargetActuator : MoveActuator<ActuatorData>
    {
        protected override Vector3 Read(ActuatorData data) => new Vector3(data.Target.X, Node.Position.y, data.Target.Z);
    }

    /// <summary>Moves a node without a body along a random path. The path depends only on the movement, the seed and the node's id.</summary>
    public sealed class Walker : MonoBehaviour
    {
        private RandomStream random;
        // Single precision would round each short step, and thus change the speed.
        private double x, z;
        private Vector3 target;
        private Vector3 direction;
        private double left;
        private double remainingPause;
        private bool hasTarget;

        internal void Walk(Node node, Movement movement, Area area, double seconds)
        {
            if (random == null)
            {
                random = RandomWalk.StreamOf(node);
                (x, z) = (transform.position.x, transform.position.z);
            }
            if (movement.kind == MovementKind.RandomWaypoint) GoToWaypoint(movement, area, seconds);
            else Roam(movement, area, movement.speed * seconds);
            transform.position = new Vector3((float)x, transform.position.y, (float)z);
        }

        private void GoToWaypoint(Movement movement, Area area, double seconds)
        {
            // A fast node may pass several waypoints in a tick.
            while (seconds > 0)
            {
                if (remainingPause > 0)
                {
                    var waited = Math.Min(remainingPause, seconds);
                    remainingPause -= waited;
                    seconds -= waited;
                    continue;
                }
                if (!hasTarget) target = area.Uniform(random) ?? new Vector3((float)x, 0, (float)z);
                hasTarget = true;
                double alongX = target.x - x, alongZ = target.z - z;
                var distance = Math.Sqrt(alongX * alongX + alongZ * alongZ);
                var reach = movement.speed * seconds;
                if (reach < distance)
                {
                    x += reach / distance * alongX;
                    z += reach / distance * alongZ;
                    return;
                }
                seconds -= distance / movement.speed;
                (x, z) = (target.x, target.z);
                hasTarget = false;
                remainingPause = movement.pause;
                if (distance == 0 && remainingPause == 0) return;
            }
        }

        private void Roam(Movement movement, Area area, double reach)
        {
            while (reach > 0)
            {
                if (left <= 0)
                {
                    var angle = random.Range(0, 2 * Mathf.PI);
                    direction = new Vector3(Mathf.Cos(angle), 0, Mathf.Sin(angle));
                    // The inverse of its distribution function converts a uniform number to the Pareto distribution.
                    left = movement.shortest * Mathf.Pow((float)(1 - random.NextDouble()), 1 / (1 - movement.exponent));
                }
                var step = Math.Min(reach, left);
                x += step * direction.x;
                z += step * direction.z;
                area.Reflect(ref x, ref z, ref direction);
                left -= step;
                reach -= step;
            }
        }
    }
}
