using System.Collections.Generic;
using System.Globalization;
using System.IO;

namespace Collektive.Headless.Bench
{
    /// <summary>Prints the rows as a table.</summary>
    internal static class Table
    {
        private const string Layout = "{0,-9} {1,-24} {2,7} {3,8} {4,12} {5,12} {6,12} {7,10} {8,12}";

        internal static void Print(List<Row> rows, TextWriter output)
        {
            Line(output, "name", "variant", "nodes", "threads", "median us", "p99 us", "min us", "managed B", "JVM B");
            foreach (var row in rows)
            {
                Line(
                    output, row.Name, row.Variant, row.Nodes, row.Threads, Number(row.Median, "0.0"), Number(row.P99, "0.0"), Number(row.Quantile(0), "0.0"),
                    Number(row.ManagedBytes, "0"), Number(row.JvmBytes, "0"));
                foreach (var more in row.More) output.WriteLine("          " + more.Key + " " + more.Value);
            }
        }

        private static void Line(TextWriter output, params object[] cells) => output.WriteLine(string.Format(CultureInfo.InvariantCulture, Layout, cells));

        private static string Number(double value, string format) => double.IsNaN(value) ? "-" : value.ToString(format, CultureInfo.InvariantCulture);
    }
}
