using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Reflection;
using Collektive.Bridge;
using Collektive.Unity;
using UnityEngine;
using UnityEngine.Headless;
using Object = UnityEngine.Object;

namespace Collektive.Headless
{
    /// <summary>One run of a scenario: builds its scene, plays it for its time, writes its outputs.</summary>
    internal sealed class ScenarioRun : IDisposable
    {
        /// <summary>Replay frames per simulated second; ticks in between are left out.</summary>
        private const double ReplayRate = 10;

        private readonly Scenario scenario;
        private readonly Options options;
        private readonly Interrupt interrupt = new Interrupt();
        private readonly List<double> stepTimes = new List<double>();
        private readonly List<double> totalTimes = new List<double>();
        private readonly List<double> roundTimes = new List<double>();
        private TimeSpan firstTick;

        internal ScenarioRun(Scenario scenario, Options options)
        {
            this.scenario = scenario;
            this.options = options;
            scenario.Seed = options.Seed ?? scenario.Seed;
            scenario.Seconds = options.Seconds ?? scenario.Seconds;
        }

        /// <returns>
        /// The exit code: that of a script's <c>Application.Quit</c>, 130 after Ctrl-C, else 0, or 1 when the simulation stopped early or rounds,
        /// sensors or actuators failed.
        /// </returns>
        internal int Run()
        {
            Directory.CreateDirectory(options.Out);
            Installation.HostJar = options.HostJar;
            Installation.JavaHome = options.JavaHome;
            Loop.Start(unchecked((int)(scenario.Seed ^ scenario.Seed >> 32)));
            var manager = MakeManager();
            var scene = MakeScene(manager);
            try
            {
                using (options.Recording == null ? null : new RecordedRun(scenario.Jvm, options.Recording)) return Play(manager, scene);
            }
            finally
            {
                Loop.Quit();
            }
        }

        public void Dispose() => interrupt.Dispose();

        private SimulationManager MakeManager()
        {
            var manager = new GameObject("Simulation Manager").AddComponent<SimulationManager>();
            manager.enabled = false;
            var settings = manager.Settings;
            settings.jars.AddRange(options.Jars);
            settings.program = scenario.Program;
            settings.seed = scenario.Seed;
            settings.deltaTime = scenario.DeltaTime;
            settings.physicsStep = scenario.PhysicsStep;
            settings.schedule = scenario.Schedule;
            settings.timing = scenario.Timing;
            settings.network = scenario.Network;
            settings.threads = scenario.Threads;
            if (scenario.Record) settings.record = Path.Combine(options.Out, "run.clkrec");
            settings.jvm = ScriptableObject.CreateInstance<JvmSettingsAsset>();
            settings.jvm.settings = scenario.Jvm;
            var problem = settings.FindProblem();
            if (problem != null) throw new ScenarioException(scenario.Path + ": " + problem);
            manager.enabled = true;
            return manager;
        }

        private SceneBuilder MakeScene(SimulationManager manager)
        {
            var type = Assembly.LoadFrom(options.Scripts).GetType(scenario.Scene);
            if (type == null || !typeof(SceneBuilder).IsAssignableFrom(type) || type.IsAbstract)
            {
                throw new ScenarioException(
                    scenario.Path + ": 'scene' names '" + scenario.Scene + "': there must be a class of that full name in " + scenario.Scripts + " that derives from SceneBuilder");
            }
            var holder = new GameObject(type.Name);
            holder.SetActive(false);
            var scene = (SceneBuilder)holder.AddComponent(type);
            SceneFields.Set(scene, scenario, options.Assignments);
            holder.SetActive(true);
            if (manager.Failure.Length > 0) throw new ScenarioException(manager.Failure);
            return scene;
        }

        private int Play(SimulationManager manager, SceneBuilder scene)
        {
            var ticks = (int)Math.Max(1, Math.Round(scenario.Seconds / scenario.DeltaTime));
            var progress = new ProgressBar(ticks);
            using (var metrics = new MetricsTable(scenario.Metrics ? Path.Combine(options.Out, "metrics.csv") : null, scene))
            using (var replay = scenario.Replay ? new ReplayRecorder(Path.Combine(options.Out, "replay.tmp"), scenario, scene, manager) : null)
            {
                metrics.EndSecond(0, 0);
                var start = new List<double>(metrics.Values);
                replay?.Add(0);
                var replayed = 0.0;
                var second = 0;
                for (var tick = 1; tick <= ticks && !interrupt.Requested && !Loop.QuitRequested; tick++)
                {
                    Loop.Frame(scenario.DeltaTime);
                    if (manager.Failure.Length > 0) throw new ScenarioException("stopped at tick " + tick + ": " + manager.Failure);
                    if (tick == 1) firstTick = DateTime.Now - Process.GetCurrentProcess().StartTime;
                    metrics.Add(manager.Times, manager.Network);
                    stepTimes.Add(manager.Times.Step);
                    totalTimes.Add(manager.Times.Total);
                    roundTimes.Add(manager.HostMicros.Rounds / 1000.0);
                    if (manager.SimulatedTime - replayed >= 1 / ReplayRate - 1e-6)
                    {
                        replayed = manager.SimulatedTime;
                        replay?.Add(replayed);
                    }
                    if (manager.SimulatedTime >= second + 1 - 1e-6) metrics.EndSecond(++second, manager.LinkCount);
                    if (progress.Due || tick == ticks) progress.Show(tick, manager.SimulatedTime, Text(scene, metrics));
                }
                progress.End();
                scene.Measure((double[])metrics.Values);
                replay?.Finish(options.Template, Path.Combine(options.Out, "replay.html"));
                var manifest = new Manifest(scenario, options, manager, scene, start, metrics.Values, progress.Seconds);
                manifest.AddTimes(roundTimes, stepTimes, totalTimes);
                manifest.AddFirstTick(firstTick);
                manifest.Write(Path.Combine(options.Out, "manifest.json"));
            }
            if (interrupt.Requested)
            {
                Console.Error.WriteLine("collektive: interrupted after " + manager.SimulatedTime + " s; the outputs end there");
                return interrupt.ExitCode;
            }
            if (Loop.QuitRequested) return Loop.ExitCode;
            if (manager.ErrorCount == 0) return 0;
            Console.Error.WriteLine("collektive: the run ended, but " + manager.ErrorCount + " rounds, sensors or actuators failed; the messages are above");
            return 1;
        }

        private static string Text(SceneBuilder scene, MetricsTable metrics)
        {
            if (scene.MetricNames.Count == 0) return "";
            return ", " + scene.MetricNames[0].Replace('_', ' ') + " " + metrics.Values[0].ToString("0.0", CultureInfo.InvariantCulture);
        }
    }
}
