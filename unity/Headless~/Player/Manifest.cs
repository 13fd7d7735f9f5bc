using System;
using System.Collections.Generic;
using System.IO;
using System.Security.Cryptography;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>
    /// Writes manifest.json with the inputs, versions and results of a run, to repeat and compare it. Measured times are in keys with "_ms" and in
    /// "wall_seconds".
    /// </summary>
    internal sealed class Manifest
    {
        /// <summary><see cref="Outcome"/> of a run that completed all its ticks, or that a script ended normally.</summary>
        internal const string Complete = "complete";

        /// <summary><see cref="Outcome"/> of a complete run without its pictures. The command creates them, then sets <see cref="Complete"/>.</summary>
        internal const string WithoutPictures = "the pictures are missing";

        /// <summary>The other files of a run.</summary>
        private static readonly string[] Files = { "metrics.csv", "nodes.csv", "replay.html", "run.clkrec" };

        private readonly string path;

        /// <summary>Describes a run that has not begun.</summary>
        /// <param name="fields">All fields of the scene, before it was built.</param>
        internal Manifest(Scenario scenario, Options options, JObject fields)
        {
            path = Path.Combine(options.Out, "manifest.json");
            Root = new JObject(
                new JProperty("outcome", "running"),
                new JProperty(OriginalRun.ScenarioKey, scenario.ToJson(fields)),
                new JProperty("file", scenario.OriginalRun?.File ?? Path.GetFileName(scenario.Path)),
                new JProperty("folder", scenario.Folder),
                new JProperty("inputs", options.Inputs),
                new JProperty("programs", Hashes(options.Jars)));
        }

        internal JObject Root { get; }

        /// <summary>"running" during the run, also if the process is killed; then <see cref="Complete"/>, or the reason why the run is not complete.</summary>
        internal string Outcome { set => Root["outcome"] = value; }

        /// <param name="parameters">Parameters of the programs that ran.</param>
        /// <param name="ticks">Completed ticks.</param>
        /// <param name="calls">Calls into the JVM.</param>
        internal void AddResults(
            SimulationManager manager, JObject parameters, int ticks, RunMetrics metrics, IReadOnlyList<double> start, IReadOnlyList<double> end,
            double wallSeconds, ulong calls)
        {
            var description = Jvm.Description.Split('\n');
            Root.Add(new JProperty("parameters", parameters));
            Root.Add(new JProperty("nodes", manager.Nodes.Count));
            Root.Add(new JProperty("ticks", ticks));
            Root.Add(new JProperty("shim_calls", calls));
            Root.Add(new JProperty("digest", manager.Digest.ToString("x16")));
            Root.Add(new JProperty("errors", manager.ErrorCount));
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

        /// <summary>Simulated seconds at which metrics have converged.</summary>
        internal void AddConvergence(JObject times) => Root.Add("converged", times);

        /// <summary>Types of the columns of nodes.csv.</summary>
        internal void AddNodeColumns(JObject types) => Root.Add("node_columns", types);

        /// <summary>Quantiles over all ticks, in milliseconds.</summary>
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

        /// <summary>From the start of the process to the end of the first tick.</summary>
        internal void AddFirstTick(TimeSpan time) => Root.Add("first_tick_ms", Math.Round(time.TotalMilliseconds));

        /// <summary>Milliseconds spent on recording frames and writing the replay page.</summary>
        internal void AddReplay(double milliseconds) => Root.Add("replay_ms", Math.Round(milliseconds));

        internal void Write() => ResultFile.Write(path, file => file.Write(Root.ToString(Formatting.Indented) + "\n"));

        /// <summary>Writes the manifest after all other files, because it records whether they are complete.</summary>
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
