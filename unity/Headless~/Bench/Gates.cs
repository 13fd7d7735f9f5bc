using System.Collections.Generic;
using System.Globalization;
using System.IO;

namespace Collektive.Headless.Bench
{
    /// <summary>Compares the measured speed with the required speed on an idle machine with two cores.</summary>
    internal static class Gates
    {
        internal static void Print(List<Row> rows, TextWriter output)
        {
            output.WriteLine();
            var at500 = Find(rows, "tick", "in-process", 500, 2);
            var engine500 = Find(rows, "tick", "engine-only", 500, 2);
            var at10000 = Find(rows, "tick", "in-process", 10000, 2);
            var single = Find(rows, "tick", "in-process", 10000, 1);
            var engine10000 = Find(rows, "tick", "engine-only", 10000, 2);
            var engineSingle = Find(rows, "tick", "engine-only", 10000, 1);
            var loops = Find(rows, "tick", "hand-written", 10000, 1);
            var at50000 = Find(rows, "tick", "in-process", 50000, 2);
            var crossing = Find(rows, "crossing", "in-process", 0, 1);
            var soak = Find(rows, "soak", "in-process", 1000, 2);
            if (at500 != null && engine500 != null)
            {
                AtMost(output, "bridge at 500 nodes, us", at500.Median - engine500.Median, System.Math.Max(0.15 * at500.Median, 60));
                AtMost(output, "tick at 500 nodes, us", at500.Median, 250);
            }
            if (crossing != null) AtMost(output, "crossing, us", crossing.Median, 15);
            var ownCrossing = Find(rows, "crossing", "own-process", 0, 1);
            var own10000 = Find(rows, "tick", "own-process", 10000, 2);
            if (crossing != null && ownCrossing != null) AtMost(output, "extra cost of a separate process, us", ownCrossing.Median - crossing.Median, 3);
            if (at10000 != null && own10000 != null) AtMost(output, "separate process / in-process, 10,000", own10000.Median / at10000.Median, 1.05);
            if (at10000 != null) AtMost(output, "tick at 10,000 nodes, us", at10000.Median, 3500);
            if (at50000 != null) AtMost(output, "tick at 50,000 nodes, us", at50000.Median, 20000);
            if (at10000 != null && loops != null) AtMost(output, "tick / hand-written loops, 10,000", at10000.Median / loops.Median, 15);
            if (at10000 != null && at500 != null) AtMost(output, "cost per node, 10,000 / 500", at10000.Median / 20 / at500.Median, 1.5);
            if (at10000 != null && single != null)
            {
                AtLeast(output, "speed-up by two threads, 10,000", single.Median / at10000.Median, 1.4);
                Part(output, "  speed-up of the rounds alone", single.Rounds / at10000.Rounds);
                Part(output, "  time outside rounds, us", at10000.Median - at10000.Rounds);
            }
            if (engine10000 != null && engineSingle != null)
                AtLeast(output, "speed-up by two threads, engine-only, 10,000", engineSingle.Median / engine10000.Median, 1.6);
            foreach (var row in rows)
            {
                if (row.Name == "tick" && (row.Variant == "in-process" || row.Variant == "own-process"))
                    AtMost(output, "managed bytes per tick, " + row.Nodes + " nodes, " + row.Variant, row.ManagedBytes, 0);
            }
            if (soak == null) return;
            AtMost(output, "soak: RSS after tick 5000, %", 100.0 * ((double)soak.More["rss_kb_end"] / (double)soak.More["rss_kb_tick_5000"] - 1), 2);
            AtMost(output, "soak: p99.9, us", soak.Quantile(0.999), System.Math.Max(5 * soak.Median, 1000));
        }

        private static Row Find(List<Row> rows, string name, string variant, int nodes, int threads) =>
            rows.Find(row => row.Name == name && row.Variant == variant && row.Nodes == nodes && row.Threads == threads);

        private static void AtMost(TextWriter output, string what, double value, double limit) => Line(output, what, value, "at most", limit, value <= limit);

        private static void AtLeast(TextWriter output, string what, double value, double limit) => Line(output, what, value, "at least", limit, value >= limit);

        /// <summary>Prints a value that is part of a required value.</summary>
        private static void Part(TextWriter output, string what, double value) =>
            output.WriteLine(string.Format(CultureInfo.InvariantCulture, "{0,-44} {1,10:0.0#}", what, value));

        private static void Line(TextWriter output, string what, double value, string relation, double limit, bool met)
        {
            output.WriteLine(string.Format(CultureInfo.InvariantCulture, "{0,-44} {1,10:0.0#} {2} {3:0.0#}{4}", what, value, relation, limit,
                met ? "" : "   MISSED"));
        }
    }
}
