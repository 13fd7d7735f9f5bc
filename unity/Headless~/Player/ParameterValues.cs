using System;
using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>Describes the parameters of the nodes' programs. Each parameter has its value, or a list of values if nodes have different ones.</summary>
    internal static class ParameterValues
    {
        internal static JObject Of(SimulationManager manager)
        {
            var programs = new JObject();
            foreach (var program in manager.Programs)
            {
                var nodes = new List<Node>();
                foreach (var node in manager.Nodes)
                {
                    if (manager.Settings.ProgramOf(node) == program.Name) nodes.Add(node);
                }
                if (nodes.Count == 0) continue;
                var parameters = new JObject();
                foreach (var parameter in program.Parameters) parameters.Add(parameter.Name, Values(parameter, nodes));
                programs.Add(program.Name, parameters);
            }
            return programs;
        }

        private static JToken Values(ProgramParameter parameter, List<Node> nodes)
        {
            var values = new SortedSet<string>(StringComparer.Ordinal);
            foreach (var node in nodes)
            {
                var set = node.Simulation.Settings.ParametersOf(node);
                var place = set.FindLastIndex(each => each.name == parameter.Name);
                values.Add(place < 0 ? parameter.DefaultValue : set[place].value);
            }
            return values.Count == 1 ? new JValue(values.Min) : (JToken)new JArray(values);
        }
    }
}
