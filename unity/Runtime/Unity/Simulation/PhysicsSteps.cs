using System;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>The physics of a tick: equal steps, none longer than the setting, that together take as long as the tick.</summary>
    internal static class PhysicsSteps
    {
        /// <summary>Does them, unless a message of physics ends the simulation.</summary>
        internal static void Advance(Simulation simulation)
        {
            var settings = simulation.Settings;
            var steps = (int)Math.Ceiling(settings.deltaTime / settings.physicsStep - 1e-6);
            var step = settings.deltaTime / steps;
            for (var i = 0; i < steps && simulation.IsOpen; i++) Physics.Simulate(step);
        }
    }
}
