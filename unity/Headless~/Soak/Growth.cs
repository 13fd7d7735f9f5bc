using System;
using System.Collections.Generic;
using System.Globalization;
using System.Xml.Linq;

namespace Collektive.Headless.Soak
{
    /// <summary>Samples of a run. Each measure may grow from the first to the last third of them by at most its allowed amount.</summary>
    internal sealed class Growth
    {
        /// <summary>Measures and their allowed growth, which is noise of collectors and compilers.</summary>
        internal static readonly (string Name, double Allowed)[] Measures =
        {
            ("managed heap, KB", 1024), ("RSS, KB", 16384), ("JVM heap, KB", 2048), ("metaspace, KB", 1024), ("classes", 100), ("threads", 1),
            ("descriptors", 1),
        };

        private readonly List<double[]> samples = new List<double[]>();

        internal void Add(double[] sample) => samples.Add(sample);

        /// <summary>Prints a table, and writes the results as JUnit XML to <paramref name="file"/> unless it is null.</summary>
        /// <returns>Whether all measures stayed within their limits.</returns>
        internal bool Report(string file)
        {
            if (samples.Count < 3) throw new InvalidOperationException("too short: " + samples.Count + " samples instead of at least 3; use more seconds");
            var results = new XElement("testsuite", new XAttribute("name", "soak"));
            var isFlat = true;
            Console.WriteLine(Row("measure", "settled", "end", "growth", "allowed"));
            for (var i = 0; i < Measures.Length; i++)
            {
                var (name, allowed) = Measures[i];
                var third = samples.Count / 3;
                var settled = Median(i, 0, third);
                var end = Median(i, samples.Count - third, samples.Count);
                var grew = end - settled > allowed;
                Console.WriteLine(Row(name, Text(settled), Text(end), Text(end - settled), Text(allowed)) + (grew ? "  GROWS" : ""));
                var result = new XElement("testcase", new XAttribute("classname", "soak"), new XAttribute("name", name));
                if (grew) result.Add(new XElement("failure", new XAttribute("message", "grew from " + Text(settled) + " to " + Text(end))));
                results.Add(result);
                isFlat &= !grew;
            }
            if (file != null) results.Save(file);
            return isFlat;
        }

        private double Median(int measure, int from, int to)
        {
            var values = samples.GetRange(from, to - from).ConvertAll(sample => sample[measure]);
            values.Sort();
            return values[values.Count / 2];
        }

        private static string Row(params string[] cells) => string.Format("{0,-18} {1,10} {2,10} {3,10} {4,10}", cells);

        private static string Text(double value) => value.ToString("0", CultureInfo.InvariantCulture);
    }
}
