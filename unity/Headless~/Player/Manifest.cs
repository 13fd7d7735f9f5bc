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
    /// <summary>manifest.json: what was run, with what, and what came out, so that a run can be repeated and compared.</summary>
    internal sealed class Manifest
    {
        private readonly JObject root;

        internal Manifest(
            Scenario scenario, Options options, SimulationManager manager, SceneBuilder scene, IReadOnlyList<double> start, IReadOnlyList<double> end,
            double wallSeconds)
        {
            var description = Jvm.Description.Split('\n');
            root = new JObject(
                new JProperty("scenario", Path.GetFileName(scenario.Path)),
                new JProperty("scene", scenario.Scene),
                new JProperty("program", scenario.Program),
                new JProperty("seed", scenario.Seed),
                new JProperty("nodes", manager.Nodes.Count),
                new JProperty("seconds", scenario.Seconds),
                new JProperty("delta_time", scenario.DeltaTime),
                new JProperty("physics_step", scenario.PhysicsStep),
                new JProperty("schedule", scenario.Schedule.ToString()),
                new JProperty("timing", JObject.FromObject(scenario.Timing)),
                new JProperty("network", JObject.FromObject(scenario.Network)),
                new JProperty("threads", scenario.Threads),
                new JProperty("fields", scenario.Fields),
                new JProperty("set", new JArray(options.Assignments)),
                new JProperty("ticks", manager.Tick),
                new JProperty("shim_calls", Jvm.StepCalls),
                new JProperty("digest", manager.Digest.ToString("x16")),
                new JProperty("errors", manager.ErrorCount),
                new JProperty("start", Metrics(scene, start)),
                new JProperty("end", Metrics(scene, end)),
                new JProperty("wall_seconds", Math.Round(wallSeconds, 3)),
                new JProperty("programs", Hashes(options.Jars)),
                new JProperty("versions", new JObject(
                    new JProperty("collektive", typeof(SimulationManager).Assembly.GetName().Version.ToString(3)),
                    new JProperty("flatbuffers", "25.12.19"),
                    new JProperty("jvm", description.Length > 1 ? description[1] : ""),
                    new JProperty("clr", Environment.Version.ToString()),
                    new JProperty("os", Environment.OSVersion.ToString()))));
        }

        /// <summary>Quantiles over all ticks, in milliseconds.</summary>
        internal void AddTimes(List<double> rounds, List<double> step, List<double> total)
        {
            root.Add("rounds_ms_median", Math.Round(Quantiles.Of(rounds, 0.5), 4));
            root.Add("step_ms_median", Math.Round(Quantiles.Of(step, 0.5), 4));
            root.Add("step_ms_p99", Math.Round(Quantiles.Of(step, 0.99), 4));
            root.Add("tick_ms_median", Math.Round(Quantiles.Of(total, 0.5), 4));
            root.Add("tick_ms_p99", Math.Round(Quantiles.Of(total, 0.99), 4));
        }

        /// <summary>From the start of the process to the end of the first tick.</summary>
        internal void AddFirstTick(TimeSpan time) => root.Add("first_tick_ms", Math.Round(time.TotalMilliseconds));

        internal void Write(string path) => File.WriteAllText(path, root.ToString(Formatting.Indented) + "\n");

        private static JObject Metrics(SceneBuilder scene, IReadOnlyList<double> values)
        {
            var metrics = new JObject();
            for (var i = 0; i < values.Count; i++) metrics.Add(scene.MetricNames[i], Math.Round(values[i], 6));
            return metrics;
        }

        private static JObject Hashes(List<string> jars)
        {
            var hashes = new JObject();
            using (var sha = SHA256.Create())
            {
                foreach (var jar in jars)
                {
                    hashes.Add(Path.GetFileName(jar), BitConverter.ToString(sha.ComputeHash(File.ReadAllBytes(Installation.PathOf(jar)))).Replace("-", "").ToLowerInvariant());
                }
            }
            return hashes;
        }
    }
}
