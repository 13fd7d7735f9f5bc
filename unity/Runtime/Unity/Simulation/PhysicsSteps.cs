using System;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Advances physics by one tick, in steps of equal length that do not exceed the physics step in the settings.</summary>
    internal sealed class PhysicsSteps
    {
        private readonly GrowingArray<Movement> moves = new GrowingArray<Movement>();

        /// <summary>The number of the current or last step; 0 before the first one.</summary>
        internal ulong Current { get; private set; }

        private struct Movement
        {
            internal NodePart Part;
            internal ulong Answer;
            internal Rigidbody Body;
            internal Vector3 OffsetPerTick;
            internal float Ticks;

            /// <summary>Whether the body is still to be moved. The next answer of the node replaces the movement.</summary>
            internal bool IsValid => Body != null && Body.isKinematic && Part.IsAttached && Part.Node.AnswerTick == Answer;
        }

        /// <summary>
        /// Moves a kinematic body by an equal part of the offset in each physics step of the next ticks, until it has moved by the whole offset. The movement
        /// ends early at the node's next answer, or when the part is disabled.
        /// </summary>
        /// <param name="offset">Metres from the body's position to its target.</param>
        /// <param name="velocity">Metres per second in the direction of the offset.</param>
        internal void Move(NodePart part, Rigidbody body, Vector3 offset, Vector3 velocity)
        {
            var perTick = part.Node.Simulation.DeltaTime * velocity;
            var length = perTick.magnitude;
            if (!(length > 0)) return;
            moves.Add() = new Movement
            {
                Part = part, Answer = part.Node.AnswerTick, Body = body, OffsetPerTick = perTick, Ticks = offset.magnitude / length,
            };
        }

        /// <summary>Runs the steps, unless a physics message ends the simulation.</summary>
        internal void Advance(Simulation simulation)
        {
            var steps = (int)Math.Ceiling(simulation.DeltaTime / simulation.PhysicsStep - 1e-6);
            var step = simulation.DeltaTime / steps;
            for (var i = 0; i < steps && simulation.IsOpen; i++)
            {
                if (moves.Count > 0) MoveBodies(steps);
                Current++;
                Physics.Simulate(step);
            }
            var remaining = 0;
            for (var i = 0; i < moves.Count; i++)
            {
                if (--moves.Items[i].Ticks > 0 && moves.Items[i].IsValid) moves.Items[remaining++] = moves.Items[i];
            }
            moves.Truncate(remaining);
        }

        private void MoveBodies(int steps)
        {
            // Physics messages of the previous step may have moved, changed or destroyed the bodies.
            Physics.SyncTransforms();
            for (var i = 0; i < moves.Count; i++)
            {
                ref var move = ref moves.Items[i];
                if (move.IsValid) move.Body.MovePosition(move.Body.position + Mathf.Min(1, move.Ticks) * move.OffsetPerTick / steps);
            }
        }
    }
}
