using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Reflection;
using System.Threading;
using Collektive.Bridge;
using Collektive.Unity;
using Mono.Unix.Native;
using Newtonsoft.Json.Linq;
using UnityEngine;
using UnityEngine.Headless;
using Object = UnityEngine.Object;

namespace Collektive.Headless
{
    /// <summary>Runs a scenario once: builds the scene, plays it for its duration, and writes the outputs.</summary>
    internal sealed class ScenarioRun
    {
        private readonly Scenario scenario;
        private readonly Options options;
        private readonly Interrupt interrupt;
        private readonly TimeSpan timeBefore;
        private readonly Stopwatch time = Stopwatch.StartNew();
        private readonly ulong callsBefore = Jvm.StepCalls;
        private readonly List<double> stepTimes = new List<double>();
        private readonly List<double> totalTimes = new List<double>();
        private readonly List<double> roundTimes = new List<double>();
        private TimeSpan firstTick;
        // The simulation of the first tick.
        private Simulation simulation;
        private Manifest manifest;
        private RunMetrics runMetrics;
        private MetricsTable metrics;
        private FrameLimit limit;
        private string cause = "";
        private int completedTicks;

        /// <param name="timeBefore">Time from the start of the run until now; null for the time since the start of the process.</param>
        internal ScenarioRun(Scenario scenario, Options options, Interrupt interrupt, TimeSpan? timeBefore = null)
        {
            this.scenario = scenario;
            this.options = options;
            this.interrupt = interrupt;
            this.timeBefore = timeBefore ?? DateTime.UtcNow - Process.GetCurrentProcess().StartTime.ToUniversalTime();
            if (scenario.OriginalRun != null
                && (options.Seed != null || options.Seconds != null || options.Assignments.Count + options.FieldAssignments.Count > 0))
            {
                throw new ScenarioException(scenario.Path
                    + ": a run can only be repeated without changes; omit --seed, --seconds and --set, or run its scenario");
            }
            scenario.Override(options.Seed, options.Seconds);
        }

        /// <summary>Runs the scenario.</summary>
        /// <returns>
        /// The exit code. After <c>Application.Quit</c> in a script, it is the script's exit code; after Ctrl-C, it is 130. It is 1 if the simulation stopped
        /// early, if rounds, components or handlers failed, or if a repeated run had different results. Otherwise, it is 0.
        /// </returns>
        internal int Run()
        {
            Directory.CreateDirectory(options.Out);
            ResultFile.OpenFolder(options.Out);
            Installation.HostJar = options.HostJar;
            Installation.JavaHome = options.JavaHome;
            Loop.PhysicsThreads = scenario.Settings.threads;
            // Loop.Start calls the initialisation methods of the loaded assemblies.
            Assembly.LoadFrom(options.Scripts);
            SimulationManager manager = null;
            SceneBuilder scene = null;
            Loop.Start(unchecked((int)(scenario.Settings.seed ^ scenario.Settings.seed >> 32)), () =>
            {
                RunLog.Install();
                // Allows frames as long as a tick, so that each frame runs one tick.
                Time.maximumDeltaTime = Mathf.Max(Time.maximumDeltaTime, scenario.Settings.deltaTime);
                manager = MakeManager();
                scene = MakeScene(manager);
            });
            manifest.Write();
            try
            {
                if (options.DebugPort != 0) DebuggedRun.AwaitDebugger(scenario.Jvm, manager.Settings, options.DebugPort, interrupt);
                using (options.Recording == null ? null : new RecordedRun(scenario.Jvm, options.Recording))
                    return options.Command == "live" ? PlayLive(manager, scene) : Play(manager, scene);
            }
            catch (ThreadAbortException) when (limit?.IsExceeded == true)
            {
                Thread.ResetAbort();
                manifest.Fail(limit.Message);
                throw new ScenarioException(limit.Message + "; the stack trace is above");
            }
            catch (Exception error)
            {
                manifest.Fail(error.Message);
                throw;
            }
            finally
            {
                Loop.Quit();
                runMetrics.Dispose();
                manifest.WriteLast();
            }
        }

        /// <summary>
        /// Checks a scenario and the fields of its scene. Does not build the scene or start the JVM. Throws a <see cref="ScenarioException"/> for an error.
        /// </summary>
        /// <returns>The names of the run's metrics.</returns>
        internal static IReadOnlyList<string> Check(Scenario scenario, Options options)
        {
            var run = new ScenarioRun(scenario, options, null);
            run.FindProblem(scenario.Settings);
            try
            {
                run.AddScene(new GameObject("Scene"));
                return run.runMetrics.Names;
            }
            finally
            {
                run.runMetrics?.Dispose();
            }
        }

        private void FindProblem(SimulationSettings settings)
        {
            var problem = settings.FindProblem();
            if (problem != null) throw new ScenarioException(scenario.Path + ": " + problem);
        }

        private SimulationManager MakeManager()
        {
            var manager = new GameObject("Simulation Manager").AddComponent<SimulationManager>();
            manager.enabled = false;
            var settings = manager.Settings;
            scenario.CopyTo(settings);
            settings.jars.AddRange(options.Jars);
            if (scenario.Record || options.Command == "live") settings.record = Path.Combine(options.Out, "run.clkrec");
            settings.jvm = ScriptableObject.CreateInstance<JvmSettingsAsset>();
            settings.jvm.settings = scenario.Jvm;
            FindProblem(settings);
            manager.enabled = true;
            // This handler is added before those of the scene, which may throw exceptions.
            manager.Ticked += Count;
            return manager;
        }

        /// <summary>Ends the process, because a frame does not end.</summary>
        private void GiveUp()
        {
            Console.Error.WriteLine("collektive: " + limit.Message);
            manifest.Fail(limit.Message);
            manifest.Write();
            Program.Exit(1);
        }

        private void Count(SimulationManager manager)
        {
            if (++completedTicks == 1)
            {
                firstTick = timeBefore + time.Elapsed;
                simulation = manager.Simulation;
            }
            metrics.Add(manager.Times, manager.Network);
            runMetrics.Ticked(manager);
            stepTimes.Add(manager.Times.Step);
            roundTimes.Add(manager.HostMicros.Rounds / 1000.0);
        }

        private SceneBuilder MakeScene(SimulationManager manager)
        {
            var holder = new GameObject("Scene");
            var scene = AddScene(holder);
            manifest = new Manifest(scenario, options, SceneFields.Get(scene));
            scenario.OriginalRun?.PrintDifferences(manifest, "inputs");
            holder.SetActive(true);
            if (manager.Failure.Length > 0) throw new ScenarioException(manager.Failure);
            return scene;
        }

        /// <summary>Adds the scene builder to an object, sets its fields and checks them. The object stays inactive.</summary>
        private SceneBuilder AddScene(GameObject holder)
        {
            var type = Assembly.LoadFrom(options.Scripts).GetType(scenario.SceneClass);
            if (type == null || !typeof(SceneBuilder).IsAssignableFrom(type) || type.IsAbstract)
            {
                throw new ScenarioException(
                    scenario.Path + ": 'scene' names '" + scenario.Scene + "': no class with this full name that derives from SceneBuilder in "
                        + scenario.Scripts);
            }
            holder.name = type.Name;
            holder.SetActive(false);
            var scene = (SceneBuilder)holder.AddComponent(type);
            SceneFields.Set(scene, scenario, options.FieldAssignments);
            DataFile.Folder = scenario.Data;
            if (scene.FindProblem() is string problem) throw SceneFields.Error(scenario, problem);
            if (scenario.NodeFields.Length > 0) NodesTable.Check(Schemas.Find(""), scenario.NodeFields);
            runMetrics = new RunMetrics(scene, scenario.MakeMetrics(), scenario.Functions);
            if (MetricsTable.FindDuplicate(runMetrics) is string metric) throw DuplicateError(scene, metric);
            scenario.Convergence.Bind(runMetrics.Names);
            return scene;
        }

        private ScenarioException DuplicateError(SceneBuilder scene, string metric)
        {
            const string Problem = "metrics.csv already has a column of that name: rename the metric";
            return scenario.Queries.Property(metric) is JProperty query
                ? scenario.File.Error(query, "'metrics." + metric + "': " + Problem)
                : new ScenarioException("the scene " + scene.GetType().FullName + " has the metric '" + metric + "', but " + Problem);
        }

        private int Play(SimulationManager manager, SceneBuilder scene)
        {
            // If the original run was interrupted, the repetition ends at the same tick.
            var ticks = scenario.OriginalRun == null ? scenario.Ticks : Math.Min(scenario.Ticks, scenario.OriginalRun.Ticks);
            if (options.IsCheck) ticks = Math.Min(ticks, 1);
            var hasReplay = scenario.Replay && !options.IsCheck;
            // The original run may have continued after failures, so a repetition continues too.
            var stopsAtFailures = !options.KeepGoing && scenario.OriginalRun == null;
            var parameters = new ParameterValues(manager);
            manager.Simulation.NodeJoined = parameters.Add;
            var hadNodes = manager.Nodes.Count > 0;
            interrupt.BeginPlay();
            var progress = new ProgressBar(ticks);
            var errors = 0L;
            using (limit = runMetrics.Limit = new FrameLimit(manager, GiveUp))
            using (metrics = new MetricsTable(scenario.Metrics ? Path.Combine(options.Out, "metrics.csv") : null, runMetrics, manager))
            using (var nodes = scenario.NodeFields.Length > 0 ? new NodesTable(Path.Combine(options.Out, "nodes.csv"), scenario.NodeFields, manager) : null)
            using (var replay = hasReplay ? NewRecorder(manager, scene) : null)
            {
                runMetrics.Begin(manager);
                EndInterval(manager, replay, 0);
                scenario.Convergence.Add(0, metrics.Values);
                nodes?.Add(0);
                var start = new List<double>(metrics.Values);
                replay?.Add(0);
                var rows = new RowSchedule(scenario.Interval, scenario.Settings.deltaTime);
                var nodeRows = new RowSchedule(scenario.NodeInterval, scenario.Settings.deltaTime);
                var ended = Stopwatch.GetTimestamp();
                for (var frame = 1; frame <= ticks && !interrupt.Requested && !Loop.QuitRequested && !manager.Finished && !HasConverged; frame++)
                {
                    var before = completedTicks;
                    // Compares with the scenario's number of ticks, so that the repetition of an interrupted run measures at the same ticks.
                    runMetrics.Prepare(manager, rows.IsDue(completedTicks + 1) || frame == (options.IsCheck ? ticks : scenario.Ticks));
                    RunFrame();
                    if (before == 0 && completedTicks > 0)
                    {
                        var began = Stopwatch.GetTimestamp();
                        manifest.Begin();
                        // The tick's time does not include writing the file.
                        ended += Stopwatch.GetTimestamp() - began;
                    }
                    if (manager.Failure.Length > 0) throw Stopped(manager);
                    RequireFirstSimulation(manager);
                    if (completedTicks - before > 1)
                        throw new ScenarioException("stopped at tick " + completedTicks
                            + ": a frame ran more than one tick; do not set Time.timeScale above 1 or call Step while the simulation is running");
                    // Without a simulation, a row would have no nodes.
                    if (completedTicks == before || !manager.Simulation.IsOpen)
                    {
                        cause = ReasonForMissingTick(manager);
                        ended = Stopwatch.GetTimestamp();
                        continue;
                    }
                    hadNodes |= manager.Nodes.Count > 0;
                    if (stopsAtFailures && manager.Simulation.AllRoundsFailed)
                        throw new ScenarioException("stopped at tick " + completedTicks
                            + ": all rounds failed; the errors are above. To continue anyway, use --keep-going");
                    if (before == 0) CheckProgramsOfParameters(manager);
                    replay?.Add(manager.SimulatedTime);
                    var now = Stopwatch.GetTimestamp();
                    totalTimes.Add((now - ended) * 1000.0 / Stopwatch.Frequency);
                    ended = now;
                    metrics.AddWhole(totalTimes[totalTimes.Count - 1]);
                    if (rows.IsDue(completedTicks))
                    {
                        EndInterval(manager, replay, manager.SimulatedTime);
                        scenario.Convergence.Add(manager.SimulatedTime, metrics.Values);
                        rows.Advance();
                    }
                    if (nodes != null && nodeRows.IsDue(completedTicks))
                    {
                        nodes.Add(manager.SimulatedTime);
                        nodeRows.Advance();
                    }
                    if (progress.Due || frame == ticks || HasConverged) progress.Show(completedTicks, manager.SimulatedTime, Text());
                }
                progress.End();
                metrics.RequireInPlace();
                nodes?.RequireInPlace();
                var record = Path.Combine(options.Out, "run.clkrec");
                // The first tick creates the record.
                if (scenario.Record && completedTicks > 0 && !File.Exists(record))
                    throw new IOException("'" + record + "' was moved or deleted during the run");
                if (manager.Simulation.IsOpen) metrics.Measure();
                replay?.Finish(options.Template, Path.Combine(options.Out, "replay.html"));
                errors = manager.ErrorCount + Loop.FailedCalls;
                manifest.AddResults(
                    manager, parameters.ToJson(), completedTicks, errors, runMetrics, start, metrics.Values, progress.Seconds, Jvm.StepCalls - callsBefore);
                manifest.AddConvergence(scenario.Convergence.Times());
                if (nodes != null) manifest.AddNodeColumns(nodes.Types);
                manifest.AddTimes(roundTimes, stepTimes, totalTimes);
                manifest.AddFirstTick(firstTick);
                if (replay != null) manifest.AddReplay(replay.Milliseconds);
            }
            scenario.OriginalRun?.PrintDifferences(manifest, "versions");
            if (interrupt.Requested)
            {
                var seconds = manager.SimulatedTime.ToString(CultureInfo.InvariantCulture);
                Console.Error.WriteLine("collektive: interrupted after " + seconds + " s; the outputs end at that time");
                manifest.Outcome = "interrupted";
                return interrupt.ExitCode;
            }
            if ((completedTicks < ticks || !manager.Simulation.IsOpen) && !manager.Finished && !Loop.QuitRequested && !HasConverged)
            {
                var problem = completedTicks + " of " + ticks + " ticks were completed" + cause;
                Console.Error.WriteLine("collektive: " + problem + "; to end a run early, use Application.Quit or a stop condition");
                manifest.Outcome = problem;
                return 1;
            }
            // If a script has ended the run, the script determines the exit code.
            if (!hadNodes && !Loop.QuitRequested)
            {
                const string Problem = "the run had no nodes";
                Console.Error.WriteLine("collektive: " + Problem + ": create GameObjects with the component Node in the scene builder");
                manifest.Outcome = Problem;
                return 1;
            }
            manifest.Outcome = scenario.Pictures ? Manifest.WithoutPictures : Manifest.Complete;
            var isRepeated = scenario.OriginalRun?.IsRepeatedBy(manifest) ?? true;
            // Exit codes have only eight bits, so 256 would become 0.
            var quitCode = Loop.ExitCode == 0 ? 0 : Math.Max(1, Loop.ExitCode & 0xff);
            if (quitCode != 0 && completedTicks == 0)
            {
                var problem = "a script ended the run with code " + quitCode + " before its first tick";
                Console.Error.WriteLine("collektive: " + problem);
                manifest.Outcome = problem;
            }
            if (errors > 0)
                Console.Error.WriteLine(
                    "collektive: the run ended, but " + errors + " errors occurred in rounds, sensors, actuators, rules, handlers or callbacks; see above");
            return errors == 0 && isRepeated ? quitCode : Math.Max(1, quitCode);
        }

        private ReplayRecorder NewRecorder(SimulationManager manager, SceneBuilder scene) => new ReplayRecorder(
            scenario, scene, runMetrics, manager, metadata => new ReplayWriter(Path.Combine(options.Out, "replay.tmp"), metadata));

        /// <summary>Plays the scene in real time until the user ends the run.</summary>
        private int PlayLive(SimulationManager manager, SceneBuilder scene)
        {
            interrupt.BeginPlay();
            using (limit = runMetrics.Limit = new FrameLimit(manager, GiveUp))
            using (metrics = new MetricsTable(null, runMetrics, manager))
            {
                runMetrics.Begin(manager);
                var live = new LiveRun(scenario, scene, runMetrics, metrics, manager, new LiveChannel(options.Channel));
                live.Play(() =>
                {
                    RunFrame();
                    RequireFirstSimulation(manager);
                }, () => interrupt.Requested || Loop.QuitRequested);
            }
            if (manager.Failure.Length > 0) throw Stopped(manager);
            manifest.Outcome = Manifest.Complete;
            return 0;
        }

        private void RunFrame()
        {
            limit.Begin(completedTicks + 1);
            Loop.Frame(scenario.Settings.deltaTime);
            limit.End();
        }

        private void RequireFirstSimulation(SimulationManager manager)
        {
            if (completedTicks > 0 && !ReferenceEquals(manager.Simulation, simulation))
                throw new ScenarioException("stopped after tick " + completedTicks
                    + ": a script disabled and enabled the Simulation Manager, which starts another simulation; do so before the first tick");
        }

        private ScenarioException Stopped(SimulationManager manager)
        {
            var tick = "tick " + (completedTicks + 1);
            var failure = manager.Failure;
            foreach (var start in new[] { tick + ": ", tick + " failed: " })
                if (failure.StartsWith(start, StringComparison.Ordinal)) failure = failure.Substring(start.Length);
            return new ScenarioException("stopped at " + tick + ": " + failure);
        }

        /// <summary>Returns the probable reason why a frame has run no tick, or an empty text.</summary>
        private static string ReasonForMissingTick(SimulationManager manager)
        {
            if (!manager) return ": a script destroyed the Simulation Manager";
            if (!manager.isActiveAndEnabled) return ": a script disabled the Simulation Manager";
            if (manager.Paused) return ": a script paused the Simulation Manager";
            return Time.timeScale == 1 ? "" : ": a script set Time.timeScale to " + Time.timeScale.ToString(CultureInfo.InvariantCulture);
        }

        /// <summary>Whether the run must end because all metrics have converged.</summary>
        private bool HasConverged => scenario.StopWhenConverged && scenario.Convergence.IsComplete;

        private void CheckProgramsOfParameters(SimulationManager manager)
        {
            foreach (var program in scenario.Settings.ProgramParameters)
            {
                var names = new List<string>();
                ProgramInfo found = null;
                foreach (var known in manager.Programs)
                {
                    names.Add(known.Name);
                    if (known.Name == program.Key) found = known;
                }
                if (found == null)
                    throw new ScenarioException("'parameters." + program.Key + "': unknown program; the programs are: " + string.Join(", ", names));
            }
        }

        private void EndInterval(SimulationManager manager, ReplayRecorder replay, double second)
        {
            var row = metrics.EndInterval(second, manager.LinkCount);
            replay?.Measure(manager.SimulatedTime, row);
        }

        private string Text()
        {
            if (runMetrics.Names.Count == 0) return "";
            return ", " + runMetrics.Names[0].Replace('_', ' ') + " " + metrics.Values[0].ToString("0.0", CultureInfo.InvariantCulture);
        }
    }
}
