using System;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Advances physics by one tick, in steps of equal length that do not exceed the physics step in the settings.</summary>
    internal sealed class PhysicsSteps
    {
        /// <summary>The simulated seconds of a movement to a target at an infinite distance.</summary>
        private const float MaxSeconds = 1e6f;

        private readonly GrowingArray<Movement> moves = new GrowingArray<Movement>();

        /// <summary>The number of the current or last step; 0 before the first one.</summary>
        internal ulong Current { get; private set; }

        private struct Movement
        {
            internal NodePart Part;
            internal ulong Answer;
            internal Rigidbody Body;
            internal Vector3 Target;
            internal float Speed;

            /// <summary>Whether the body is still to be moved. The next answer of the node replaces the movement.</summary>
            internal bool IsValid => Part.IsAttached && Part.Node.AnswerTick == Answer && Body != null && Body.isKinematic;
        }

        /// <summary>
        /// Moves a kinematic body to a target in each physics step, until the node's next answer or until the part is disabled. Of several movements of one
        /// body, the last one counts.
        /// </summary>
        /// <param name="offset">Metres from the body's position to its target. The length may be infinite.</param>
        /// <param name="velocity">Metres per second in the direction of the offset.</param>
        internal void Move(NodePart part, Rigidbody body, Vector3 offset, Vector3 velocity)
        {
            var speed = velocity.magnitude;
            var target = speed > 0 ? body.position + Mathf.Min(offset.magnitude / speed, MaxSeconds) * velocity : body.position;
            moves.Add() = new Movement { Part = part, Answer = part.Node.AnswerTick, Body = body, Target = target, Speed = speed };
        }

        /// <summary>Runs the steps, unless a physics message ends the simulation.</summary>
        internal void Advance(Simulation simulation)
        {
            var steps = (int)Math.Ceiling(simulation.DeltaTime / simulation.PhysicsStep - 1e-6);
            var step = simulation.DeltaTime / steps;
            for (var i = 0; i < steps && simulation.IsOpen; i++)
            {
                if (moves.Count > 0) MoveBodies(step);
                Current++;
                Physics.Simulate(step);
            }
        }

        private void MoveBodies(float seconds)
        {
            // Physics messages of the previous step may have moved, changed or destroyed the bodies.
            Physics.SyncTransforms();
            var remaining = 0;
            for (var i = 0; i < moves.Count; i++)
            {
                var move = moves.Items[i];
                if (!move.IsValid) continue;
                move.Body.MovePosition(Vector3.MoveTowards(move.Body.position, move.Target, seconds * move.Speed));
                moves.Items[remaining++] = move;
            }
            moves.Truncate(remaining);
        }
    }
}
