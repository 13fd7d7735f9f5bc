using System;
using System.Collections.Generic;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>All metrics of a run: first those of the scene, then those of the scenario in SQL, then those that are functions of programs.</summary>
    internal sealed class RunMetrics : IDisposable
    {
        private readonly SceneBuilder scene;
        private readonly SqlMetrics queries;
        private readonly FunctionMetrics functions;
        private readonly List<string> names;
        private readonly double[] own;

        internal RunMetrics(SceneBuilder scene, SqlMetrics queries, FunctionMetrics functions)
        {
            this.scene = scene;
            this.queries = queries;
            this.functions = functions;
            names = new List<string>(scene.MetricNames);
            own = new double[names.Count];
            names.AddRange(queries.Names);
            names.AddRange(functions.Names);
        }

        internal IReadOnlyList<string> Names => names;

        /// <summary>The limit of the metrics of the scene; null for none.</summary>
        internal FrameLimit Limit { private get; set; }

        /// <summary>Requests the data that the metrics need, beginning with the next tick.</summary>
        internal void Begin(SimulationManager manager) => queries.Begin(manager);

        /// <summary>Sets whether the next tick evaluates the functions.</summary>
        internal void Prepare(SimulationManager manager, bool isDue) => functions.Prepare(manager, isDue);

        /// <summary>Copies the data of a tick, because the next tick overwrites it.</summary>
        internal void Ticked(SimulationManager manager)
        {
            queries.Ticked(manager);
            functions.Ticked(manager);
        }

        /// <summary>Evaluates all metrics at the current time, in the order of <see cref="Names"/>.</summary>
        internal void Measure(SimulationManager manager, double[] values)
        {
            Limit?.BeginMetrics();
            try
            {
                scene.Measure(own);
            }
            finally
            {
                Limit?.End();
            }
            own.CopyTo(values, 0);
            queries.Measure(manager, values, own.Length);
            functions.Measure(manager, values, own.Length + queries.Names.Count);
        }

        public void Dispose() => queries.Dispose();
    }
}
