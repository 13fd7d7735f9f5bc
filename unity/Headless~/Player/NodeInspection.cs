using System;
using System.Collections;
using System.Collections.Generic;
using System.Globalization;
using System.Reflection;
using Collektive.Bridge;
using Collektive.FlatBuffers;
using Collektive.Unity;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>Describes one node after a tick, as text for the live page.</summary>
    internal static class NodeInspection
    {
        private const int MaxRows = 60;

        /// <summary>Returns sensor data, answer, last error, incoming links, state and last round of a node; null for an unknown node.</summary>
        internal static JObject Of(SimulationManager manager, int id)
        {
            var node = id < 0 ? null : manager.Find(id);
            if (node == null) return null;
            // The answer contains the state of the node only after a tick that has inspected it.
            var answer = manager.Tick > 0 && manager.Simulation.Answer.InspectedNode == id ? manager.Simulation.Answer : null;
            return new JObject(
                new JProperty("id", id), new JProperty("program", manager.Settings.ProgramOf(node)),
                new JProperty("sensors", Rows(Sensed(manager.Simulation, id))), new JProperty("answer", Rows(node.Answer)),
                new JProperty("error", node.LastError), new JProperty("links", Links(manager, id)),
                new JProperty("state", answer == null ? null : State(answer)),
                new JProperty("roundMicros", answer?.InspectedRoundNanos / 1000.0));
        }

        /// <summary>Returns the path and the text of each value in the node's state.</summary>
        private static JArray State(StepAnswer answer)
        {
            var rows = new JArray();
            for (var i = 0; i < answer.StateCount; i++)
            {
                var (path, value) = answer.State(i);
                rows.Add(new JArray(path, value));
            }
            return rows;
        }

        /// <summary>Returns the sender and the length of each link on which a node receives messages.</summary>
        private static JArray Links(SimulationManager manager, int id)
        {
            var rows = new JArray();
            var links = new List<LinkRecord>();
            manager.CopyLinks(links);
            foreach (var link in links)
                if (link.To == id && rows.Count < MaxRows) rows.Add(new JArray("node " + link.From, Text(link.Length) + " m"));
            return rows;
        }

        private static object Sensed(Simulation simulation, int id)
        {
            for (var i = 0; i < simulation.DueCount; i++)
                if (simulation.DueId(i) == id) return simulation.SensorData.Get(i);
            return null;
        }

        private static JArray Rows(object data)
        {
            var rows = new JArray();
            if (data != null) Add(rows, "", data);
            return rows;
        }

        private static void Add(JArray rows, string path, object value)
        {
            if (rows.Count == MaxRows) return;
            if (Text(value) is string text)
            {
                rows.Add(new JArray(path, text));
                return;
            }
            if (value is IEnumerable items)
            {
                var index = 0;
                foreach (var item in items) Add(rows, path + "[" + index++ + "]", item);
                if (index == 0) rows.Add(new JArray(path, "empty"));
                return;
            }
            foreach (var member in value.GetType().GetMembers(BindingFlags.Public | BindingFlags.Instance))
            {
                var isData = member is FieldInfo || member is PropertyInfo property && property.CanRead && property.GetIndexParameters().Length == 0;
                if (isData && AnswerField.TypeOf(member) != typeof(ByteBuffer))
                    Add(rows, path.Length == 0 ? member.Name : path + "." + member.Name, AnswerField.ValueOf(member, value));
            }
        }

        /// <summary>Returns the text of a simple value, or null for an object with fields.</summary>
        private static string Text(object value)
        {
            switch (value)
            {
                case null: return "none";
                case float number: return number.ToString("G6", CultureInfo.InvariantCulture);
                case double number: return number.ToString("G6", CultureInfo.InvariantCulture);
                case bool truth: return truth ? "true" : "false";
                case string _:
                case Enum _: return value.ToString();
                default: return value.GetType().IsPrimitive ? Convert.ToString(value, CultureInfo.InvariantCulture) : null;
            }
        }
    }
}
