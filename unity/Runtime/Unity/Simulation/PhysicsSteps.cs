using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Advances physics by one tick, in steps of equal length that do not exceed the physics step in the settings.</summary>
    internal static class PhysicsSteps
    {
        /// <summary>Runs the steps, unless a physics message ends the simulation.</summary>
        internal static void Advance(Simulation simulation)
        {
            var settings = simulation.Settings;
            var steps = (int)Math.Ceiling(settings.deltaTime / settings.physicsStep - 1e-6);
            var step = settings.deltaTime / steps;
            for (var i = 0; i < steps && simulation.IsOpen; i++) Physics.Simulate(step);
        }
    }
}
