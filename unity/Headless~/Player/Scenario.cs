using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>
    /// A scenario, from a scenario file or from the manifest of a run to repeat. In the file, paths are relative to its folder. The properties contain
    /// absolute paths.
    /// </summary>
    internal sealed class Scenario
    {
        private const int Version = 1;

        /// <summary>Maximum number of ticks, because a run keeps the times of all its ticks in memory.</summary>
        private const double MaxTicks = 1e8;

        private const string StandardScene = "standard";

        /// <summary>Folder with the sources of the standard scene, in the clone that contains this program.</summary>
        private static readonly string StandardFolder =
            System.IO.Path.GetFullPath(System.IO.Path.Combine(AppDomain.CurrentDomain.BaseDirectory, "../../unity/Headless~/Standard"));

        private static readonly string[] OwnKeys =
        {
            "version", "scene", "scripts", "schema", "programs", "data", "parameters", "fields", "seconds", "metrics", "converged", "stopWhenConverged", "jvm",
            "outputs",
        };

        /// <summary>The fields of the settings that are also keys of a scenario. Other keys set the remaining fields.</summary>
        private static readonly FieldInfo[] Shared = typeof(SimulationSettings).GetFields(BindingFlags.Public | BindingFlags.Instance).Where(field =>
            !new[]
            {
                nameof(SimulationSettings.schema), nameof(SimulationSettings.jars), nameof(SimulationSettings.jvm), nameof(SimulationSettings.stopAfter),
                nameof(SimulationSettings.record), nameof(SimulationSettings.libraries), nameof(SimulationSettings.defaultProgram),
            }.Contains(field.Name)).ToArray();

        /// <summary>All top-level keys of a scenario.</summary>
        internal static IEnumerable<string> Keys => OwnKeys.Concat(Shared.Select(field => field.Name));

        private readonly JObject root;

        private Scenario(JsonFile file, string path, JObject root, string folder, bool trustsJvm)
        {
            this.root = root;
            file.RejectUnknownKeys(root, "", Keys);
            var version = file.Required<int>(root, "version");
            if (version != Version) throw file.Error(root["version"], "version " + version + " is not supported; use version " + Version);
            File = file;
            Path = path;
            Folder = folder;
            Scene = file.Required<string>(root, "scene");
            // Sweeps write copies of the scenario in which both keys are set.
            var isOurs = Scene == StandardScene && root["scripts"] == null && root["schema"] == null;
            Scripts = isOurs ? StandardFolder : ExistingPath(file, root, "scripts", folder, directory: true);
            Schema = isOurs ? System.IO.Path.Combine(StandardFolder, "standard.fbs") : ExistingPath(file, root, "schema", folder, directory: false);
            Programs = ExistingPath(file, root, "programs", folder, directory: null);
            if (root["data"] != null) Data = ReadData(file, root, folder);
            Fields = file.Optional(root, "fields", new JObject());
            Seconds = file.Required<double>(root, "seconds");
            file.Required<string>(root, nameof(SimulationSettings.program));
            file.Fill(Settings, Shared, root, "");
            ReadParameters(file, file.Optional(root, "parameters", new JObject()));
            Queries = file.Optional(root, "metrics", new JObject());
            Functions = new FunctionMetrics(file, Queries);
            Convergence = Convergence.Read(file, file.Optional(root, "converged", new JObject()), Settings.deltaTime);
            StopWhenConverged = file.Optional(root, "stopWhenConverged", false);
            if (StopWhenConverged && Convergence.Criteria.Count == 0)
                throw file.Error(root["stopWhenConverged"], "'stopWhenConverged' needs 'converged', which defines when a metric has converged");
            if (Settings.runtime == AggregateRuntime.Collektive)
            {
                RuntimeJars = ExistingPath(file, root, nameof(SimulationSettings.runtimeJars), folder, directory: true);
                // The compiler plugin is needed only for sources. A jar contains compiled programs.
                if (Directory.Exists(Programs)) RuntimePlugin = ExistingPath(file, root, nameof(SimulationSettings.runtimePlugin), folder, directory: false);
            }
            Jvm = ReadJvm(file, file.Part(root, "", "jvm", JvmSetting.All.Select(setting => setting.Key)), folder, trustsJvm);
            var outputs = file.Part(root, "", "outputs", new[] { "metrics", "interval", "nodes", "replay", "pictures", "record" });
            Metrics = file.Optional(outputs, "metrics", true);
            Interval = ReadInterval(file, outputs, "outputs.");
            var nodes = file.Part(outputs, "outputs.", "nodes", new[] { "fields", "interval" });
            NodeFields = file.Optional(nodes, "fields", new string[0]);
            if (NodeFields.GroupBy(field => field).FirstOrDefault(group => group.Count() > 1) is IGrouping<string, string> repeated)
                throw file.Error(nodes["fields"], "'outputs.nodes.fields' contains '" + repeated.Key + "' twice");
            NodeInterval = ReadInterval(file, nodes, "outputs.nodes.");
            Replay = file.Optional(outputs, "replay", false);
            Pictures = file.Optional(outputs, "pictures", false);
            Record = file.Optional(outputs, "record", false);
            Count(message => file.Error(root["seconds"], message));
            if (Pictures && !Replay)
                throw file.Error(outputs["pictures"], "'outputs.pictures' needs 'outputs.replay': pictures are taken from the replay page");
        }

        internal JsonFile File { get; }

        internal string Path { get; }

        /// <summary>Folder to which the paths in the file are relative.</summary>
        internal string Folder { get; }

        /// <summary>The run to repeat, if the file is a manifest; otherwise null.</summary>
        internal OriginalRun OriginalRun { get; private set; }

        internal string Scene { get; }

        /// <summary>Full name of the scene builder's class.</summary>
        internal string SceneClass => Scene == StandardScene ? "Collektive.Standard.StandardScene" : Scene;

        internal string Scripts { get; }

        internal string Schema { get; }

        internal string Programs { get; }

        /// <summary>Folder of data files; empty if the scenario has none.</summary>
        internal string Data { get; } = "";

        /// <summary>Folder of Collektive's jars; empty with the built-in runtime.</summary>
        internal string RuntimeJars { get; } = "";

        /// <summary>Collektive's compiler plugin; empty with the built-in runtime and with compiled programs.</summary>
        internal string RuntimePlugin { get; } = "";

        internal JObject Fields { get; }

        /// <summary>The settings of the simulation, which Unity shows in the inspector of the manager.</summary>
        internal SimulationSettings Settings { get; } = new SimulationSettings();

        internal double Seconds { get; private set; }

        /// <summary>The number of ticks in <see cref="Seconds"/>.</summary>
        internal int Ticks { get; private set; }

        internal JvmSettings Jvm { get; }

        internal bool Metrics { get; }

        /// <summary>Simulated seconds between two rows of the metrics.</summary>
        internal double Interval { get; }

        /// <summary>Fields of the answers in the table of nodes; empty if the table is not written.</summary>
        internal string[] NodeFields { get; }

        /// <summary>Simulated seconds between two rows of a node in the table of nodes.</summary>
        internal double NodeInterval { get; }

        /// <summary>Definitions of the scenario's metrics, by name.</summary>
        internal JObject Queries { get; }

        /// <summary>The metrics that are functions of the programs.</summary>
        internal FunctionMetrics Functions { get; }

        /// <summary>The criteria by which metrics converge.</summary>
        internal Convergence Convergence { get; }

        /// <summary>Whether the run ends when all metrics of <see cref="Convergence"/> have converged.</summary>
        internal bool StopWhenConverged { get; }

        internal bool Replay { get; }

        internal bool Pictures { get; }

        internal bool Record { get; }

        /// <summary>Reads and checks a scenario.</summary>
        /// <param name="path">A scenario file, or the manifest of a run.</param>
        /// <param name="folder">Folder to which paths are relative; null for the folder of the file or, for a manifest, of the original file.</param>
        /// <param name="trustsJvm">Whether the JVM settings in the file may write files, open ports and load code.</param>
        /// <param name="assignments">Values that replace those in a scenario file. They do not affect a manifest.</param>
        internal static Scenario Read(string path, string folder, bool trustsJvm, params Assignment[] assignments)
        {
            var file = JsonFile.Read(path);
            path = FullPath(path);
            if (!(file.Root[OriginalRun.ScenarioKey] is JObject run))
            {
                foreach (var assignment in assignments) assignment.Apply(file.Root);
                return new Scenario(file, path, file.Root, FullPath(folder ?? System.IO.Path.GetDirectoryName(path)), trustsJvm);
            }
            var original = new OriginalRun(file, path);
            folder = FullPath(folder ?? original.Folder);
            if (!Directory.Exists(folder))
                throw new ScenarioException(path + ": the run's folder does not exist: " + folder + " (if it was moved, use --folder)");
            return new Scenario(file, path, run, folder, trustsJvm) { OriginalRun = original };
        }

        /// <summary>Replaces seed and duration with those of the command line, unless they are null.</summary>
        internal void Override(ulong? seed, double? seconds)
        {
            Settings.seed = seed ?? Settings.seed;
            Seconds = seconds ?? Seconds;
            if (seconds != null) Count(message => new ScenarioException("--seconds " + Text(seconds.Value) + ": " + message));
        }

        /// <summary>Checks and prepares the metrics in SQL. The schema's code must be loaded.</summary>
        internal SqlMetrics MakeMetrics() => new SqlMetrics(File, Queries, Queries.Count == 0 ? null : Schemas.Find(""), Settings.stepLimitMs);

        /// <summary>Copies the shared settings to those of the manager.</summary>
        internal void CopyTo(SimulationSettings settings)
        {
            foreach (var field in Shared) field.SetValue(settings, field.GetValue(Settings));
            settings.runtimeJars = RuntimeJars;
            settings.runtimePlugin = RuntimePlugin;
            settings.Metrics = Functions.Functions;
            foreach (var parameters in Settings.ProgramParameters) settings.ProgramParameters.Add(parameters.Key, parameters.Value);
        }

        private void ReadParameters(JsonFile file, JObject programs)
        {
            foreach (var program in programs.Properties())
            {
                var values = new List<NodeParameter>();
                var key = "parameters." + program.Name;
                foreach (var value in ((JObject)file.Convert(program.Value, typeof(JObject), key)).Properties())
                {
                    var type = value.Value.Type == JTokenType.Boolean ? typeof(bool) : value.Value.Type == JTokenType.Integer ? typeof(long)
                        : value.Value.Type == JTokenType.Float ? typeof(double) : typeof(string);
                    values.Add(new NodeParameter(value.Name, ProgramText(file.Convert(value.Value, type, key + "." + value.Name))));
                }
                Settings.ProgramParameters.Add(program.Name, values);
            }
        }

        /// <summary>Returns the value of a parameter as the text that programs receive.</summary>
        private static string ProgramText(object value) =>
            value is bool truth ? truth ? "true" : "false" : value is double number ? CsvText.Number(number)
                : System.Convert.ToString(value, System.Globalization.CultureInfo.InvariantCulture);

        private JObject ParametersToJson()
        {
            var programs = new JObject();
            foreach (var program in Settings.ProgramParameters)
            {
                var values = new JObject();
                foreach (var parameter in program.Value) values.Add(parameter.name, parameter.value);
                programs.Add(program.Key, values);
            }
            return programs;
        }

        private double ReadInterval(JsonFile file, JObject part, string place)
        {
            var deltaTime = SimulatedSeconds.Exact(Settings.deltaTime);
            var interval = file.Optional(part, "interval", System.Math.Max(1.0, deltaTime));
            // An interval that is equal to the delta time may have more digits than a float. An invalid delta time is reported later, with the other settings.
            if ((float)interval >= Settings.deltaTime && interval <= MaxTicks || float.IsNaN(Settings.deltaTime)) return System.Math.Max(interval, deltaTime);
            throw file.Error(
                part["interval"] ?? root,
                "'" + place + "interval' is " + Text(interval) + ": it must be " + (interval > MaxTicks
                    ? "at most " + Text(MaxTicks) + " s" : "at least 'deltaTime', " + Text(deltaTime) + " s"));
        }

        /// <summary>Returns the scenario as a scenario file in which all keys are set, including those with default values.</summary>
        internal JObject ToJson(JObject fields)
        {
            var jvm = new JObject();
            foreach (var setting in JvmSetting.All) jvm.Add(setting.Key, JsonFile.Token(setting.Get(Jvm)));
            var json = new JObject(
                new JProperty("version", Version),
                new JProperty("scene", Scene),
                new JProperty("programs", root["programs"]),
                new JProperty("parameters", ParametersToJson()),
                new JProperty("fields", fields),
                new JProperty("seconds", Seconds),
                new JProperty("metrics", Queries),
                new JProperty("converged", Convergence.ToJson()),
                new JProperty("stopWhenConverged", StopWhenConverged),
                new JProperty("jvm", jvm),
                new JProperty("outputs", new JObject(
                    new JProperty("metrics", Metrics),
                    new JProperty("interval", Interval),
                    new JProperty("nodes", new JObject(new JProperty("fields", new JArray(NodeFields)), new JProperty("interval", NodeInterval))),
                    new JProperty("replay", Replay),
                    new JProperty("pictures", Pictures),
                    new JProperty("record", Record))));
            foreach (var key in new[] { "scripts", "schema", "data" })
                if (root[key] != null) json.Add(key, root[key]);
            foreach (var field in Shared)
            {
                var value = field.GetValue(Settings);
                json.Add(field.Name, JsonFile.Token(value) ?? JObject.FromObject(value));
            }
            return json;
        }

        private void Count(System.Func<string, ScenarioException> error)
        {
            // An invalid delta time is reported later, with the other settings.
            var deltaTime = SimulatedSeconds.Exact(Settings.deltaTime);
            var ticks = deltaTime > 0 ? System.Math.Round(Seconds / deltaTime) : 1;
            if (!(Seconds > 0) || double.IsInfinity(Seconds)) throw error("'seconds' is " + Text(Seconds) + ": it must be a number greater than 0");
            if (ticks > MaxTicks)
                throw error("'seconds' is " + Text(Seconds) + ": with a 'deltaTime' of " + Text(deltaTime) + " that is " + Text(ticks)
                    + " ticks, and the maximum is 100 million; use a shorter run or a longer 'deltaTime'");
            Ticks = (int)System.Math.Max(1, ticks);
        }

        private static string Text(double number) => number.ToString("G6", System.Globalization.CultureInfo.InvariantCulture);

        private static string ReadData(JsonFile file, JObject root, string folder)
        {
            var data = ExistingPath(file, root, "data", folder, directory: true).TrimEnd('/');
            if (!(folder + "/").StartsWith(data + "/", StringComparison.Ordinal)) return data;
            throw file.Error(root["data"], "'data' contains the scenario: name a folder that contains only data files, which are copied and hashed");
        }

        private static JvmSettings ReadJvm(JsonFile file, JObject root, string folder, bool trusted)
        {
            var settings = new JvmSettings();
            foreach (var setting in JvmSetting.All)
            {
                var token = root[setting.Key];
                if (token == null) continue;
                var value = file.Convert(token, setting.Type, "jvm." + setting.Key);
                var isFolder = setting.Key == nameof(JvmSettings.home) && ((string)value).Length > 0;
                setting.Set(settings, isFolder ? Combine(file, token, "jvm." + setting.Key, folder, (string)value) : value);
            }
            foreach (var problem in settings.FindProblems()) throw file.Error(root[problem.Key] ?? root, "'jvm." + problem.Key + "': " + problem.Message);
            if (!trusted) RejectUnsafeSettings(file, root, settings);
            if (settings.home.Length > 0 && settings.location != JvmLocation.Folder)
                throw file.Error(root[nameof(settings.home)], "'jvm.home' needs the 'jvm.location' Folder: the location " + settings.location + " ignores it");
            return settings;
        }

        /// <summary>Rejects JVM settings that may affect this machine. The scenario may be from someone else, so the user must trust them first.</summary>
        private static void RejectUnsafeSettings(JsonFile file, JObject root, JvmSettings settings)
        {
            const string hint = "; add --trust-jvm if you trust the file, or remove it";
            if (settings.home.Length > 0)
                throw file.Error(root[nameof(settings.home)], "'jvm.home' is refused because it runs a JVM from a folder that the file chooses" + hint);
            if (settings.debugPort != 0)
            {
                throw file.Error(
                    root[nameof(settings.debugPort)],
                    "'jvm.debugPort' is refused because any user of this machine who can reach the port can run code" + hint);
            }
            for (var i = 0; i < settings.flags.Count; i++)
            {
                if (SafeJvmFlags.Contains(settings.flags[i])) continue;
                throw file.Error(
                    root[nameof(settings.flags)],
                    "'jvm.flags[" + i + "]', " + settings.flags[i]
                        + ", is refused because it is not known to be safe: it may write files, open ports or load code" + hint);
            }
        }

        /// <summary>Returns the absolute path. Removes a second leading slash, because Mono would interpret the path as a Windows share.</summary>
        private static string FullPath(string path) =>
            System.IO.Path.GetFullPath(path.StartsWith("//", StringComparison.Ordinal) ? "/" + path.TrimStart('/') : path);

        private static string Combine(JsonFile file, JToken place, string key, string folder, string named)
        {
            if (named.IndexOf('\0') >= 0) throw file.Error(place, "'" + key + "' contains a null character");
            return System.IO.Path.Combine(folder, named);
        }

        private static string ExistingPath(JsonFile file, JObject root, string key, string folder, bool? directory)
        {
            var named = file.Required<string>(root, key);
            var path = FullPath(Combine(file, root[key], key, folder, named));
            var isDirectory = Directory.Exists(path);
            var isFile = RegularFile.Exists(path);
            if (directory == null ? isDirectory || isFile : directory.Value ? isDirectory : isFile) return path;
            var kind = directory == null ? "jar or folder" : directory.Value ? "folder" : "file";
            throw file.Error(root[key], "'" + key + "' does not name a " + kind + ": " + path);
        }
    }
}
