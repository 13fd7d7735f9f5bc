using System;
using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>The metrics of a scenario that are functions of its programs. They have values only after ticks in which they were measured.</summary>
    internal sealed class FunctionMetrics
    {
        private readonly List<string> names = new List<string>();
        private readonly List<string> functions = new List<string>();
        private readonly double[] values;
        private double measuredTime = -1;
        private string problem;

        internal FunctionMetrics(JsonFile file, JObject root)
        {
            foreach (var property in root.Properties())
            {
                if (!IsFunction(property)) continue;
                var place = "metrics." + property.Name + ".";
                var part = file.Part(root, "metrics.", property.Name, new[] { "function" });
                if (part["function"] == null) throw file.Error(property, "'" + place + "function' is missing");
                names.Add(property.Name);
                functions.Add((string)file.Convert(part["function"], typeof(string), place + "function"));
            }
            values = new double[names.Count];
        }

        internal IReadOnlyList<string> Names => names;

        /// <summary>Names of the functions, in the order of <see cref="Names"/>, the names of the metrics.</summary>
        internal IReadOnlyList<string> Functions => functions;

        /// <summary>Returns whether a metric is a function. Otherwise, it is SQL.</summary>
        internal static bool IsFunction(JProperty metric) => metric.Value is JObject;

        /// <summary>Sets whether the next tick evaluates the functions.</summary>
        internal void Prepare(SimulationManager manager, bool isDue) => manager.Simulation.Measures = isDue && names.Count > 0;

        /// <summary>Reads the values of a tick.</summary>
        internal void Ticked(SimulationManager manager)
        {
            var answer = manager.Simulation.Answer;
            if (answer.MetricCount == 0) return;
            for (var i = 0; i < values.Length; i++)
            {
                var (value, error) = answer.Metric(i);
                values[i] = value;
                if (error != null) problem = "'metrics." + names[i] + "': the function '" + functions[i] + "' failed: " + error;
            }
            measuredTime = manager.SimulatedTime;
        }

        /// <summary>Copies the values to an array, starting at an index. They are NaN if the last tick has not evaluated the functions.</summary>
        internal void Measure(SimulationManager manager, double[] target, int first)
        {
            if (problem != null) throw new ScenarioException(problem);
            for (var i = 0; i < values.Length; i++) target[first + i] = manager.SimulatedTime == measuredTime ? values[i] : double.NaN;
        }
    }
}
