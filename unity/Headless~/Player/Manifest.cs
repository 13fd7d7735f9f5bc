using System;
using System.Collections.Generic;
using System.IO;
using System.Security.Cryptography;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>
    /// Writes manifest.json with the inputs, versions and results of a run, so that users can repeat the run and compare results. Only the keys with "_ms"
    /// and "wall_seconds" contain measured times.
    /// </summary>
    internal sealed class Manifest
    {
        /// <summary><see cref="Outcome"/> of a run that completed all its ticks, or that a script ended normally.</summary>
        internal const string Complete = "complete";

        /// <summary><see cref="Outcome"/> of a complete run without pictures. The command creates them, and then sets <see cref="Complete"/>.</summary>
        internal const string WithoutPictures = "the pictures are missing";

        /// <summary>The other output files of a run.</summary>
        private static readonly string[] Files = { "metrics.csv", "nodes.csv", "replay.html", "run.clkrec" };

        private readonly string path;

        /// <summary>Creates the manifest of a run that has not begun.</summary>
        /// <param name="fields">All fields of the scene before it is built.</param>
        internal Manifest(Scenario scenario, Options options, JObject fields)
        {
            path = Path.Combine(options.Out, "manifest.json");
            Root = new JObject(
                new JProperty("outcome", "running"),
                new JProperty(OriginalRun.ScenarioKey, scenario.ToJson(fields)),
                new JProperty("file", scenario.OriginalRun?.File ?? Path.GetFileName(scenario.Path)),
                new JProperty("folder", scenario.Folder),
                new JProperty("inputs", options.Inputs),
                new JProperty("programs", Hashes(options.Jars)),
                new JProperty("ticks", 0));
        }

        internal JObject Root { get; }

        /// <summary>
        /// The outcome: "running" during the run, then <see cref="Complete"/> or the reason why the run is not complete. If the process is killed, it remains
        /// "running".
        /// </summary>
        internal string Outcome { set => Root["outcome"] = value; }

        internal void Fail(string problem) => Outcome = "failed: " + problem;

        /// <summary>Writes the manifest after the first tick. Before, it has 0 ticks, and the command keeps the results that the run would replace.</summary>
        internal void Begin()
        {
            Root.Remove("ticks");
            Write();
        }

        /// <summary>Adds the results and the versions.</summary>
        /// <param name="parameters">Parameters of the programs that ran.</param>
        /// <param name="ticks">Number of completed ticks.</param>
        /// <param name="errors">Number of failed rounds, sensors, actuators, rules, handlers and callbacks.</param>
        /// <param name="start">Values of the metrics before the first tick.</param>
        /// <param name="end">Values of the metrics after the last tick.</param>
        /// <param name="calls">Number of calls into the JVM.</param>
        internal void AddResults(
            SimulationManager manager, JObject parameters, int ticks, long errors, RunMetrics metrics, IReadOnlyList<double> start, IReadOnlyList<double> end,
            double wallSeconds, ulong calls)
        {
            var description = Jvm.Description.Split('\n');
            Root.Add(new JProperty("parameters", parameters));
            Root.Add(new JProperty("nodes", manager.Nodes.Count));
            Root["ticks"] = ticks;
            Root.Add(new JProperty("shim_calls", calls));
            Root.Add(new JProperty("digest", manager.Digest.ToString("x16")));
            Root.Add(new JProperty("errors", errors));
            Root.Add(new JProperty("start", Metrics(metrics, start)));
            Root.Add(new JProperty("end", Metrics(metrics, end)));
            Root.Add(new JProperty("wall_seconds", Math.Round(wallSeconds, 3)));
            Root.Add(new JProperty("versions", new JObject(
                    new JProperty("collektive", typeof(SimulationManager).Assembly.GetName().Version.ToString(3)),
                    new JProperty("flatbuffers", "25.12.19"),
                    new JProperty("jvm", description.Length > 1 ? description[1] : ""),
                    new JProperty("clr", Environment.Version.ToString()),
                    new JProperty("os", Environment.OSVersion.ToString()))));
        }

        /// <summary>Adds the simulated seconds at which metrics have converged.</summary>
        internal void AddConvergence(JObject times) => Root.Add("converged", times);

        /// <summary>Adds the types of the columns of nodes.csv.</summary>
        internal void AddNodeColumns(JObject types) => Root.Add("node_columns", types);

        /// <summary>Adds quantiles of the times of all ticks, in milliseconds.</summary>
        internal void AddTimes(List<double> rounds, List<double> step, List<double> total)
        {
            Root.Add("rounds_ms_median", Math.Round(Quantiles.Of(rounds, 0.5), 4));
            Root.Add("step_ms_median", Math.Round(Quantiles.Of(step, 0.5), 4));
            Root.Add("step_ms_p99", Math.Round(Quantiles.Of(step, 0.99), 4));
            var sum = 0.0;
            foreach (var time in total) sum += time;
            Root.Add("ticks_ms", Math.Round(sum, 4));
            Root.Add("tick_ms_median", Math.Round(Quantiles.Of(total, 0.5), 4));
            Root.Add("tick_ms_p99", Math.Round(Quantiles.Of(total, 0.99), 4));
        }

        /// <summary>Adds the time from the start of the run to the end of the first tick.</summary>
        internal void AddFirstTick(TimeSpan time) => Root.Add("first_tick_ms", Math.Round(time.TotalMilliseconds));

        /// <summary>Adds the milliseconds that were spent on recording frames and writing the replay page.</summary>
        internal void AddReplay(double milliseconds) => Root.Add("replay_ms", Math.Round(milliseconds));

        internal void Write() => ResultFile.Write(path, file => file.Write(JsonFile.Text(Root) + "\n"));

        /// <summary>Writes the final manifest. All other files are on the disk before it, because it states whether they are complete.</summary>
        internal void WriteLast()
        {
            foreach (var name in Files) ResultFile.Sync(Path.Combine(Path.GetDirectoryName(path), name));
            Write();
        }

        private static JObject Metrics(RunMetrics metrics, IReadOnlyList<double> values)
        {
            var json = new JObject();
            for (var i = 0; i < values.Count; i++) json.Add(metrics.Names[i], values[i]);
            return json;
        }

        private static JObject Hashes(List<string> jars)
        {
            var hashes = new JObject();
            using (var sha = SHA256.Create())
            {
                foreach (var jar in jars)
                {
                    var hash = sha.ComputeHash(File.ReadAllBytes(Installation.PathOf(jar)));
                    hashes.Add(Path.GetFileName(jar), BitConverter.ToString(hash).Replace("-", "").ToLowerInvariant());
                }
            }
            return hashes;
        }
    }
}
