using System;
using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>
    /// Determines which metrics have converged. A metric has converged if its value stays in a band for a number of simulated seconds. The time of
    /// convergence is the start of this period. Only values at the rows of the metrics count.
    /// </summary>
    internal sealed class Convergence
    {
        private readonly List<Criterion> criteria = new List<Criterion>();

        internal IReadOnlyList<Criterion> Criteria => criteria;

        /// <summary>Whether criteria exist and all metrics have converged.</summary>
        internal bool IsComplete => criteria.Count > 0 && criteria.TrueForAll(criterion => criterion.Time != null);

        /// <summary>Reads the criteria of the metrics.</summary>
        /// <param name="deltaTime">Length of a tick in simulated seconds.</param>
        internal static Convergence Read(JsonFile file, JObject metrics, float deltaTime)
        {
            var convergence = new Convergence();
            foreach (var property in metrics.Properties())
            {
                var key = "converged." + property.Name;
                var part = file.Part(metrics, "converged.", property.Name, new[] { "from", "to", "seconds" });
                var criterion = new Criterion(
                    property.Name, file.Optional(part, "from", double.NegativeInfinity), file.Optional(part, "to", double.PositiveInfinity),
                    file.Optional(part, "seconds", 0.0), deltaTime);
                if (part["from"] == null && part["to"] == null)
                    throw file.Error(part, "'" + key + "' needs 'from', 'to' or both: the band of the metric's values");
                if (!(criterion.From <= criterion.To)) throw file.Error(part, "'" + key + "': 'from' is greater than 'to'; swap them");
                if (!(criterion.Seconds >= 0)) throw file.Error(part, "'" + key + ".seconds' must be 0 or greater");
                convergence.criteria.Add(criterion);
            }
            return convergence;
        }

        /// <summary>Finds the metric of each criterion among the run's metrics.</summary>
        internal void Bind(IReadOnlyList<string> names)
        {
            foreach (var criterion in criteria)
            {
                criterion.Index = new List<string>(names).IndexOf(criterion.Metric);
                if (criterion.Index >= 0) continue;
                throw new ScenarioException(
                    "'converged." + criterion.Metric + "': unknown metric; the metrics are: " + string.Join(", ", names));
            }
        }

        /// <summary>Adds a row of the metrics.</summary>
        internal void Add(double second, IReadOnlyList<double> values)
        {
            foreach (var criterion in criteria) criterion.Add(second, values[criterion.Index]);
        }

        internal JObject ToJson()
        {
            var json = new JObject();
            foreach (var criterion in criteria) json.Add(criterion.Metric, criterion.ToJson());
            return json;
        }

        /// <summary>Returns the times of convergence in simulated seconds, by metric; null for metrics that have not converged.</summary>
        internal JObject Times()
        {
            var json = new JObject();
            foreach (var criterion in criteria) json.Add(criterion.Metric, criterion.Time);
            return json;
        }

        /// <summary>The criterion by which one metric converges.</summary>
        internal sealed class Criterion
        {
            private readonly double shortestPeriod;
            private double? since;

            internal Criterion(string metric, double from, double to, double seconds, float deltaTime)
            {
                // Rows of an interval of 1 s may be 30 ticks of 0.033333 s apart. A period that lacks a whole tick is too short.
                shortestPeriod = Math.Max(seconds * (1 - RowSchedule.Tolerance), seconds - deltaTime / 2);
                Metric = metric;
                From = from;
                To = to;
                Seconds = seconds;
            }

            internal string Metric { get; }

            internal double From { get; }

            internal double To { get; }

            internal double Seconds { get; }

            internal int Index { get; set; }

            /// <summary>Time of convergence in simulated seconds; null before convergence.</summary>
            internal double? Time { get; private set; }

            internal void Add(double second, double value)
            {
                if (!(value >= From && value <= To)) since = null;
                else since = since ?? second;
                // The metric cannot converge at second 0, because no round has run yet.
                if (since != null && second > 0 && second - since >= shortestPeriod)
                    Time = Time ?? Math.Round(since.Value, 6, MidpointRounding.AwayFromZero);
            }

            internal JObject ToJson()
            {
                var json = new JObject();
                if (!double.IsInfinity(From)) json.Add("from", From);
                if (!double.IsInfinity(To)) json.Add("to", To);
                json.Add("seconds", Seconds);
                return json;
            }
        }
    }
}
