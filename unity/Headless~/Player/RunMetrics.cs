using System;
using System.Collections.Generic;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>All metrics of a run: those of the scene, then those of the scenario.</summary>
    internal sealed class RunMetrics : IDisposable
    {
        private readonly SceneBuilder scene;
        private readonly SqlMetrics queries;
        private readonly List<string> names;
        private readonly double[] own;

        internal RunMetrics(SceneBuilder scene, SqlMetrics queries)
        {
            this.scene = scene;
            this.queries = queries;
            names = new List<string>(scene.MetricNames);
            own = new double[names.Count];
            names.AddRange(queries.Names);
        }

        internal IReadOnlyList<string> Names => names;

        /// <summary>Requests what metrics need from the next tick on.</summary>
        internal void Begin(SimulationManager manager) => queries.Begin(manager);

        /// <summary>Copies the data that the next tick overwrites.</summary>
        internal void Ticked(SimulationManager manager) => queries.Ticked(manager);

        /// <summary>Evaluates all metrics at the current time, in the order of <see cref="Names"/>.</summary>
        internal void Measure(SimulationManager manager, double[] values)
        {
            scene.Measure(own);
            own.CopyTo(values, 0);
            queries.Measure(manager, values, own.Length);
        }

        public void Dispose() => queries.Dispose();
    }
}
