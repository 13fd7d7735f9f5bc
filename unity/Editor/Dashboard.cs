using System;
using System.Collections.Generic;
using System.Globalization;
using Collektive.Bridge;

namespace Collektive.Unity.Editor
{
    /// <summary>Describes the state of a running simulation as names and values, for the manager's inspector.</summary>
    internal static class Dashboard
    {
        internal static List<KeyValuePair<string, string>> Of(SimulationManager manager)
        {
            var lines = new List<KeyValuePair<string, string>>();
            void Add(string name, string value) => lines.Add(new KeyValuePair<string, string>(name, value));

            Add("State", State(manager));
            Add("Tick", manager.Tick + " (" + Number(manager.SimulatedTime, "0.00") + " s)");
            Add("Nodes", manager.Nodes.Count.ToString(CultureInfo.InvariantCulture));
            Add("Links", manager.LinkCount.ToString(CultureInfo.InvariantCulture));
            Add("Messages", Messages(manager.Network));
            Add("Errors", manager.ErrorCount.ToString(CultureInfo.InvariantCulture));
            var times = manager.Times;
            Add("Queries", Milliseconds(times.Queries));
            Add("Rules", Milliseconds(times.Rules));
            Add("Sense", Milliseconds(times.Sense));
            Add("Step", Milliseconds(times.Step) + ", of which rounds " + Milliseconds(manager.HostMicros.Rounds / 1000.0));
            Add("Act", Milliseconds(times.Act));
            Add("Physics", Milliseconds(times.Physics));
            Add("Whole tick", Milliseconds(times.Total));
            Add("Digest", manager.Digest.ToString("x16", CultureInfo.InvariantCulture));
            return lines;
        }

        internal static string State(SimulationManager manager)
        {
            if (manager.Failure.Length > 0) return "stopped: " + manager.Failure;
            if (!manager.isActiveAndEnabled) return "disabled";
            if (manager.Simulation.IsPending) return "JVM stopped by the debugger";
            return manager.Paused ? "paused" : "running";
        }

        /// <summary>Returns the message counts of the last tick as text.</summary>
        private static string Messages(in NetworkCounts counts) =>
            FormattableString.Invariant($"{counts.Sent} sent, {counts.Dropped} dropped, {counts.Delayed} delayed, {counts.Expired} expired");

        internal static string Milliseconds(double value) => Number(value, "0.00") + " ms";

        private static string Number(double value, string format) => value.ToString(format, CultureInfo.InvariantCulture);
    }
}
