using System;
using System.Collections.Generic;
using System.Threading;
using Collektive.Headless.Tests.Simulation;
using Collektive.Unity;
using UnityEngine;

namespace Collektive.Headless.Faults
{
    /// <summary>A scene that ends its process as <see cref="how"/> selects, while its nodes run.</summary>
    public sealed class Ending : SceneBuilder
    {
        /// <summary>leave, quit, ctrl-c, termination, exception, or thread-exception.</summary>
        public string how = "leave";

        private static readonly string[] Names = { "ticks" };
        private SimulationManager simulation;

        public override IReadOnlyList<string> MetricNames => Names;

        public override void Measure(double[] values)
        {
            values[0] = simulation.Tick;
            if (how == "exception" && simulation.Tick >= 20) throw new InvalidOperationException("unhandled");
        }

        protected override void Build(SimulationManager manager)
        {
            simulation = manager;
            manager.Settings.schema = "probe.ProbeSchema";
            manager.Ticked += OnTick;
            for (var i = 0; i < 20; i++)
            {
                var node = new GameObject("Node");
                node.AddComponent<Node>();
                node.AddComponent<ProbeSensor>();
                node.AddComponent<ProbeActuator>();
            }
        }

        private void OnTick(SimulationManager manager)
        {
            if (manager.Tick < 10) return;
            if (manager.Tick == 10) Console.WriteLine("ten ticks done");
            if (how == "quit") Application.Quit(3);
            if (how == "thread-exception" && manager.Tick == 10) new Thread(() => throw new InvalidOperationException("unhandled")).Start();
        }
    }
}
