using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using Collektive.Bridge;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>metrics.csv: a row per simulated second; messages are sums over the second's ticks, times medians, in milliseconds.</summary>
    internal sealed class MetricsTable : IDisposable
    {
        private readonly TextWriter writer;
        private readonly SceneBuilder scene;
        private readonly double[] values;
        private readonly List<TickTimes> second = new List<TickTimes>();
        private readonly List<double> sorted = new List<double>();
        private long sent, dropped, delayed, expired;

        internal MetricsTable(string path, SceneBuilder scene)
        {
            this.scene = scene;
            values = new double[scene.MetricNames.Count];
            writer = path == null ? TextWriter.Null : new StreamWriter(path);
            var names = values.Length == 0 ? "" : string.Join(",", scene.MetricNames) + ",";
            writer.Write("second," + names + "links,sent,dropped,delayed,expired,sense_ms,step_ms,act_ms,physics_ms,tick_ms_p99\n");
        }

        /// <summary>The scene's metrics at the last row.</summary>
        internal IReadOnlyList<double> Values => values;

        internal void Add(TickTimes times, NetworkCounts network)
        {
            second.Add(times);
            sent += network.Sent;
            dropped += network.Dropped;
            delayed += network.Delayed;
            expired += network.Expired;
        }

        internal void EndSecond(int number, int links)
        {
            scene.Measure(values);
            var row = number.ToString(CultureInfo.InvariantCulture);
            foreach (var value in values) row += "," + Text(value);
            row += "," + links.ToString(CultureInfo.InvariantCulture);
            foreach (var count in new[] { sent, dropped, delayed, expired }) row += "," + count.ToString(CultureInfo.InvariantCulture);
            row += "," + Text(Quantile(t => t.Sense, 0.5)) + "," + Text(Quantile(t => t.Step, 0.5)) + "," + Text(Quantile(t => t.Act, 0.5));
            row += "," + Text(Quantile(t => t.Physics, 0.5)) + "," + Text(Quantile(t => t.Total, 0.99));
            writer.Write(row + "\n");
            // A run that is killed keeps what it has measured.
            writer.Flush();
            second.Clear();
            sent = dropped = delayed = expired = 0;
        }

        public void Dispose() => writer.Dispose();

        private double Quantile(Converter<TickTimes, double> phase, double quantile)
        {
            sorted.Clear();
            foreach (var times in second) sorted.Add(phase(times));
            return Quantiles.Of(sorted, quantile);
        }

        private static string Text(double value) => value.ToString("0.####", CultureInfo.InvariantCulture);
    }
}
