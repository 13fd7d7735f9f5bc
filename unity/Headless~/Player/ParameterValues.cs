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
            Add(programs, manager, 0);
            return programs;
        }

        /// <summary>Adds the values of the nodes whose ids are not below an id to a description.</summary>
        internal static void Add(JObject programs, SimulationManager manager, int firstId)
        {
            foreach (var program in manager.Programs)
            {
                var nodes = new List<Node>();
                foreach (var node in manager.Nodes)
                {
                    if (node.Id >= firstId && manager.Settings.ProgramOf(node) == program.Name) nodes.Add(node);
                }
                if (nodes.Count == 0) continue;
                if (programs[program.Name] == null) programs.Add(program.Name, new JObject());
                var parameters = (JObject)programs[program.Name];
                foreach (var parameter in program.Parameters) parameters[parameter.Name] = Values(parameter, nodes, parameters[parameter.Name]);
            }
        }

        private static JToken Values(ProgramParameter parameter, List<Node> nodes, JToken known)
        {
            var values = new SortedSet<string>(StringComparer.Ordinal);
            if (known != null) values.UnionWith(known is JArray list ? list.Values<string>() : new[] { (string)known });
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
