using System;
using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>Describes the parameters of the nodes' programs. Each parameter has its value, or a list of values if nodes have different ones.</summary>
    internal sealed class ParameterValues
    {
        private readonly SortedDictionary<string, List<Values>> programs = new SortedDictionary<string, List<Values>>(StringComparer.Ordinal);
        private readonly SimulationManager manager;

        internal ParameterValues(SimulationManager manager)
        {
            this.manager = manager;
        }

        /// <summary>Describes the present parameters of all nodes.</summary>
        internal static JObject Of(SimulationManager manager)
        {
            var values = new ParameterValues(manager);
            foreach (var node in manager.Nodes) values.Add(node, node.Simulation.Settings.ParametersOf(node));
            return values.ToJson();
        }

        /// <summary>Adds the values with which a node joins the simulation.</summary>
        internal void Add(Node node, List<NodeParameter> set)
        {
            var program = manager.Settings.ProgramOf(node);
            if (!programs.TryGetValue(program, out var parameters))
            {
                parameters = new List<Values>();
                foreach (var known in manager.Programs)
                {
                    if (known.Name != program) continue;
                    foreach (var parameter in known.Parameters) parameters.Add(new Values(parameter));
                }
                programs.Add(program, parameters);
            }
            foreach (var parameter in parameters) parameter.Add(set);
        }

        internal JObject ToJson()
        {
            var all = new JObject();
            foreach (var program in programs)
            {
                var parameters = new JObject();
                foreach (var parameter in program.Value) parameters.Add(parameter.Name, parameter.ToJson());
                all.Add(program.Key, parameters);
            }
            return all;
        }

        /// <summary>The distinct values of a parameter.</summary>
        private sealed class Values
        {
            private readonly SortedSet<string> distinct = new SortedSet<string>(StringComparer.Ordinal);
            private readonly ProgramParameter parameter;

            internal Values(ProgramParameter parameter)
            {
                this.parameter = parameter;
            }

            internal string Name => parameter.Name;

            internal void Add(List<NodeParameter> set)
            {
                var place = set.FindLastIndex(each => each.name == parameter.Name);
                distinct.Add(place < 0 ? parameter.DefaultValue : set[place].value);
            }

            internal JToken ToJson() => distinct.Count == 1 ? new JValue(distinct.Min) : (JToken)new JArray(distinct);
        }
    }
}
