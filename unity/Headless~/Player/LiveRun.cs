using System;
using System.Diagnostics;
using System.Linq;
using System.Text.RegularExpressions;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Collektive.Headless
{
    /// <summary>
    /// Plays a scene in real time. <c>./collektive live</c> controls it with commands, and receives events.
    /// </summary>
    /// <remarks>
    /// A command is a JSON object with one of these keys: <c>run</c> (true or false), <c>step</c> (number of ticks), <c>speed</c> (simulated seconds per
    /// second), <c>reload</c>, <c>add</c> (number of nodes; with the point <c>at</c>), <c>remove</c> (id), <c>select</c> (id or null), <c>parameter</c> (its
    /// name; with <c>program</c> and <c>value</c>). The events are <c>header</c> (the header of FORMAT.md, with data for the controls), <c>frame</c>,
    /// <c>reload</c>, <c>warning</c> and <c>stopped</c>.
    /// </remarks>
    internal sealed class LiveRun
    {
        /// <summary>Maximum time limit of a tick. It is short, because the page cannot be updated while a tick hangs.</summary>
        private const int StepLimitMs = 4000;

        /// <summary>Maximum number of nodes that one command can add.</summary>
        private const int MaxAdded = 10000;

        private const int SlotsPerRow = 1024;

        /// <summary>A number in Java, as in scripts/build/player.py.</summary>
        private static readonly Regex JavaNumber = new Regex(
            @"^\s*[+-]?(NaN|Infinity|((\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|0[xX]([\da-fA-F]+\.?[\da-fA-F]*|\.[\da-fA-F]+)[pP][+-]?\d+)[fFdD]?)\s*$",
            RegexOptions.ECMAScript);

        private readonly Scenario scenario;
        private readonly SceneBuilder scene;
        private readonly RunMetrics runMetrics;
        private readonly MetricsTable metrics;
        private readonly SimulationManager manager;
        private readonly LiveChannel channel;
        private readonly ReplayRecorder recorder;
        private readonly RowSchedule rows;
        private readonly JArray metricNames;
        private readonly Stopwatch clock = Stopwatch.StartNew();
        private ReplayWriter writer;
        private JArray newMetrics;
        private bool isRunning = true;
        private int steps;
        private double speed = 1;
        private double nextTickMs;
        private int ticks;
        private int capacity;
        private int selected = -1;
        private bool hasMetricsFailed;

        internal LiveRun(
            Scenario scenario, SceneBuilder scene, RunMetrics runMetrics, MetricsTable metrics, SimulationManager manager, LiveChannel channel)
        {
            this.scenario = scenario;
            this.scene = scene;
            this.runMetrics = runMetrics;
            this.metrics = metrics;
            this.manager = manager;
            this.channel = channel;
            manager.Settings.stepLimitMs = Math.Min(manager.Settings.stepLimitMs, StepLimitMs);
            metricNames = new JArray(MetricsTable.NamesOf(runMetrics));
            rows = new RowSchedule(scenario.Interval, scenario.Settings.deltaTime);
            recorder = new ReplayRecorder(scenario, scene, runMetrics, manager, metadata => writer = new ReplayWriter(metadata, SendFrame));
        }

        /// <summary>Plays until the user ends the run or the simulation stops.</summary>
        /// <param name="frame">Runs a frame of the player.</param>
        /// <param name="isEnded">Returns whether the user ended the run.</param>
        internal void Play(Action frame, Func<bool> isEnded)
        {
            recorder.Add(0);
            while (!isEnded())
            {
                // Waits for at most 100 ms, so that isEnded is checked often.
                var wait = isRunning || steps > 0 ? nextTickMs - clock.Elapsed.TotalMilliseconds : 100;
                if (channel.TryTake(Math.Max(0, (int)Math.Min(wait, 100)), out var command)) Execute(command);
                else if ((isRunning || steps > 0) && nextTickMs <= clock.Elapsed.TotalMilliseconds) Tick(frame);
                // After a failure, the manager is disabled.
                if (manager && manager.isActiveAndEnabled) continue;
                var message = manager.Failure.Length > 0 ? manager.Failure : "a script disabled or destroyed the Simulation Manager";
                channel.Send(new JObject(new JProperty("event", "stopped"), new JProperty("message", message)));
                break;
            }
            channel.Flush();
        }

        private void Tick(Action frame)
        {
            var interval = 1000 * scenario.Settings.deltaTime / speed;
            // If the simulation is too slow for real time, it does not try to catch up later.
            nextTickMs = Math.Max(nextTickMs + interval, clock.Elapsed.TotalMilliseconds - interval);
            var tick = manager.Tick;
            runMetrics.Prepare(manager, rows.IsDue(ticks + 1));
            frame();
            if (!manager.Simulation.IsOpen || manager.Tick == tick) return;
            ticks++;
            if (rows.IsDue(ticks))
            {
                Measure();
                rows.Advance();
            }
            var answer = manager.Simulation.Answer;
            if (answer.HasReload)
            {
                var reload = answer.Reload;
                channel.Send(new JObject(
                    new JProperty("event", "reload"), new JProperty("error", reload.Error), new JProperty("kept", reload.Kept),
                    new JProperty("stored", reload.Stored)));
                SendHeader();
            }
            if (ticks == 1) SendHeader();
            if (isRunning) recorder.Add(manager.SimulatedTime);
            else
            {
                steps--;
                recorder.AddNow();
            }
        }

        private void Measure()
        {
            if (hasMetricsFailed) return;
            try
            {
                newMetrics = new JArray(new JValue(manager.SimulatedTime));
                foreach (var value in metrics.EndInterval(manager.SimulatedTime, manager.LinkCount))
                    newMetrics.Add(double.IsNaN(value) || double.IsInfinity(value) ? null : (double?)value);
            }
            catch (Exception error)
            {
                // For example, the scene may not expect the user to remove nodes.
                hasMetricsFailed = true;
                newMetrics = null;
                Notify("the metrics of the scene failed and are no longer measured: " + error.Message);
            }
        }

        private void Execute(string line)
        {
            try
            {
                var command = (JObject)JsonFile.Parse(line);
                if (command["run"] != null) Run((bool)command["run"]);
                else if (command["step"] != null) Step((int)command["step"]);
                else if (command["speed"] != null) SetSpeed(Number(command["speed"]));
                else if (command["reload"] != null) manager.ReloadPrograms();
                else if (command["add"] != null) AddNodes((int)command["add"], (JArray)command["at"]);
                else if (command["remove"] != null) RemoveNode((int)command["remove"]);
                else if (command["parameter"] != null) SetParameter((string)command["program"], (string)command["parameter"], (string)command["value"]);
                else if (command.Property("select") != null) manager.Simulation.Inspected = selected = (int?)command["select"] ?? -1;
                else throw new ArgumentException("unknown command");
                // The page must show the effect of a command even while the simulation is paused.
                if (!isRunning) recorder.Record(manager.SimulatedTime);
            }
            catch (Exception error) when (error is ArgumentException || error is InvalidCastException || error is FormatException || error is OverflowException
                || error is JsonException)
            {
                Notify("a command from the page is invalid: " + error.Message);
            }
        }

        private static double Number(JToken token)
        {
            var number = (double)token;
            // Positions are floats.
            if (!(Math.Abs(number) <= float.MaxValue)) throw new ArgumentException(token + " is not a finite number");
            return number;
        }

        private void Run(bool runs)
        {
            isRunning = runs;
            steps = 0;
            nextTickMs = clock.Elapsed.TotalMilliseconds;
        }

        private void Step(int count)
        {
            isRunning = false;
            steps += Math.Min(Math.Max(count, 1), 1000);
            nextTickMs = clock.Elapsed.TotalMilliseconds;
        }

        private void SetSpeed(double value)
        {
            speed = Math.Min(Math.Max(value, 0.01), 100);
            // At the previous speed, the next tick may be minutes away.
            nextTickMs = Math.Min(nextTickMs, clock.Elapsed.TotalMilliseconds + 1000 * scenario.Settings.deltaTime / speed);
        }

        /// <summary>Adds copies of a node on a spiral around a point.</summary>
        private void AddNodes(int count, JArray at)
        {
            if (count < 1 || count > MaxAdded) throw new ArgumentException("from 1 to " + MaxAdded + " nodes can be added at once");
            if (at?.Count != 3) throw new ArgumentException("'at' must be a position");
            if (manager.Nodes.Count == 0)
            {
                Notify("no nodes were added: a new node is a copy of an existing one, and the scene has no nodes");
                return;
            }
            var template = manager.Nodes[manager.Nodes.Count - 1];
            var centre = new Vector3((float)Number(at[0]), template.transform.position.y, (float)Number(at[2]));
            var gap = 2.5f * Mathf.Max(writer.NodeRadius, 0.05f);
            // Copies must not request the id of the template.
            var id = template.RequestedId;
            template.RequestedId = -1;
            try
            {
                for (var i = 0; i < count; i++)
                {
                    // With the golden angle, the places are evenly distributed.
                    var angle = i * 2.39996f;
                    var distance = gap * Mathf.Sqrt(i);
                    var place = centre + new Vector3(distance * Mathf.Cos(angle), 0, distance * Mathf.Sin(angle));
                    Object.Instantiate(template.gameObject, place, template.transform.rotation).name = template.name + " copy";
                }
            }
            finally
            {
                template.RequestedId = id;
            }
        }

        private void SetParameter(string program, string name, string value)
        {
            foreach (var known in manager.Programs)
            {
                if (known.Name != program) continue;
                foreach (var parameter in known.Parameters)
                {
                    if (parameter.Name != name) continue;
                    if (FindProblem(parameter, value) is string problem) Notify("parameter '" + name + "' " + problem);
                    else manager.Simulation.SetParameter(program, name, value);
                    return;
                }
            }
            Notify("program '" + program + "' has no parameter '" + name + "'");
        }

        /// <summary>Returns the reason why the engine would reject a value and end the simulation, or null.</summary>
        internal static string FindProblem(ProgramParameter parameter, string value)
        {
            if (value == null) return "must have a value";
            if (parameter.Type == ParameterType.Enum)
                return parameter.Values.Contains(value) ? null : "must be one of " + string.Join(", ", parameter.Values);
            return !JavaNumber.IsMatch(parameter.DefaultValue) || JavaNumber.IsMatch(value) ? null : "must be a number";
        }

        private void RemoveNode(int id)
        {
            var node = manager.Find(id);
            if (node != null) Object.DestroyImmediate(node.gameObject);
        }

        private void SendFrame(byte[] segment, int length)
        {
            var needed = (writer.Slots + SlotsPerRow - 1) / SlotsPerRow * SlotsPerRow;
            if (needed > capacity)
            {
                capacity = capacity == 0 ? needed : 2 * needed;
                SendHeader();
            }
            channel.SendFrame(Describe(), segment, length);
            newMetrics = null;
        }

        private JObject Describe() => new JObject(
            new JProperty("event", "frame"),
            new JProperty("time", manager.SimulatedTime),
            new JProperty("tick", manager.Tick),
            new JProperty("running", isRunning),
            new JProperty("speed", speed),
            new JProperty("errors", manager.ErrorCount),
            new JProperty("error", LastError()),
            new JProperty("metrics", newMetrics),
            new JProperty("poses", recorder.TakePoses()),
            new JProperty("node", NodeInspection.Of(manager, selected)));

        private string LastError()
        {
            NodeErrors last = null;
            foreach (var errors in manager.Errors)
                if (last == null || errors.LastTick > last.LastTick) last = errors;
            return last == null ? "" : last.Source + (last.Node >= 0 ? ", node " + last.Node : "") + ": " + last.LastMessage;
        }

        private void SendHeader()
        {
            var header = writer.Header();
            header["event"] = "header";
            header["slots"] = capacity;
            header["metrics"] = metricNames;
            header["program"] = scenario.Settings.program;
            header["sceneFields"] = SceneFields.Get(scene);
            var programs = new JObject();
            foreach (var program in manager.Programs)
            {
                var parameters = new JArray();
                foreach (var parameter in program.Parameters)
                    parameters.Add(new JObject(
                        new JProperty("name", parameter.Name), new JProperty("default", parameter.DefaultValue),
                        new JProperty("description", parameter.Description)));
                programs.Add(program.Name, parameters);
            }
            header["programs"] = programs;
            header["parameters"] = ParameterValues.Of(manager);
            header["network"] = JObject.FromObject(scenario.Settings.network);
            channel.Send(header);
        }

        private void Notify(string message) => channel.Send(new JObject(new JProperty("event", "warning"), new JProperty("message", message)));
    }
}
