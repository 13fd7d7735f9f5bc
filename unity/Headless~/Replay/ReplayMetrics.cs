using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>Metrics for the charts of a replay page, with one row per measurement.</summary>
    public sealed class ReplayMetrics
    {
        private readonly JArray times = new JArray();
        private readonly JArray series = new JArray();

        /// <param name="names">The names of the metrics, in the order of the values in a row.</param>
        public ReplayMetrics(IEnumerable<string> names)
        {
            foreach (var name in names) series.Add(new JObject { ["name"] = name, ["values"] = new JArray() });
        }

        /// <param name="time">Simulated seconds, greater than in the previous row.</param>
        /// <param name="values">One value for each name. Values that are not finite become gaps in the chart.</param>
        public void Add(double time, IReadOnlyList<double> values)
        {
            times.Add(time);
            for (var i = 0; i < series.Count; i++)
            {
                var isFinite = !double.IsNaN(values[i]) && !double.IsInfinity(values[i]);
                ((JArray)series[i]["values"]).Add(isFinite ? new JValue(values[i]) : JValue.CreateNull());
            }
        }

        internal JObject ToJson() => new JObject { ["times"] = times, ["series"] = series };
    }
}
