using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The physics of a tick: equal steps, at most as long as the setting, that add up to the tick.</summary>
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
