using System;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Advances physics by one tick, in steps of equal length that do not exceed the physics step in the settings.</summary>
    internal sealed class PhysicsSteps
    {
        private readonly GrowingArray<Movement> moves = new GrowingArray<Movement>();

        private struct Movement
        {
            internal NodePart Part;
            internal ulong Answer;
            internal Rigidbody Body;
            internal Vector3 OffsetPerTick;
            internal int Ticks;

            /// <summary>Whether the body is still to be moved. The next answer of the node replaces the movement.</summary>
            internal bool IsValid => Body != null && Body.isKinematic && Part.IsAttached && Part.Node.AnswerTick == Answer;
        }

        /// <summary>
        /// Moves a kinematic body by an equal part of the offset in each physics step of the next ticks, as many ticks as the interval of the node's answers
        /// has. The movement ends early at the node's next answer, or when the part is disabled.
        /// </summary>
        internal void Move(NodePart part, Rigidbody body, Vector3 offset)
        {
            var ticks = Math.Max(1, (int)Math.Round(part.Node.AnswerInterval / part.Node.Simulation.DeltaTime));
            moves.Add() = new Movement { Part = part, Answer = part.Node.AnswerTick, Body = body, OffsetPerTick = offset / ticks, Ticks = ticks };
        }

        /// <summary>Runs the steps, unless a physics message ends the simulation.</summary>
        internal void Advance(Simulation simulation)
        {
            var steps = (int)Math.Ceiling(simulation.DeltaTime / simulation.PhysicsStep - 1e-6);
            var step = simulation.DeltaTime / steps;
            for (var i = 0; i < steps && simulation.IsOpen; i++)
            {
                if (moves.Count > 0) MoveBodies(steps);
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
                if (move.IsValid) move.Body.MovePosition(move.Body.position + move.OffsetPerTick / steps);
            }
        }
    }
}
