using System;
using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Advances physics by one tick, in steps of equal length that do not exceed the physics step in the settings.</summary>
    internal sealed class PhysicsSteps
    {
        private readonly GrowingArray<(Rigidbody Body, Vector3 Offset)> moves = new GrowingArray<(Rigidbody Body, Vector3 Offset)>();

        /// <summary>Moves a kinematic body in the next tick's worth of steps, by an equal part of the offset in each step.</summary>
        internal void Move(Rigidbody body, Vector3 offset) => moves.Add() = (body, offset);

        /// <summary>Runs the steps, unless a physics message ends the simulation.</summary>
        internal void Advance(Simulation simulation)
        {
            var settings = simulation.Settings;
            var steps = (int)Math.Ceiling(settings.deltaTime / settings.physicsStep - 1e-6);
            var step = settings.deltaTime / steps;
            for (var i = 0; i < steps && simulation.IsOpen; i++)
            {
                if (moves.Count > 0) MoveBodies(steps);
                Physics.Simulate(step);
            }
            moves.Clear();
        }

        private void MoveBodies(int steps)
        {
            // Physics messages of the previous step may have moved, changed or destroyed the bodies.
            Physics.SyncTransforms();
            for (var i = 0; i < moves.Count; i++)
            {
                var (body, offset) = moves.Items[i];
                if (body != null && body.isKinematic) body.MovePosition(body.position + offset / steps);
            }
        }
    }
}
