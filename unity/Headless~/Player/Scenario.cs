using System.IO;
using System.Linq;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json.Linq;
using org.collektive.frame;

namespace Collektive.Headless
{
    /// <summary>A scenario file. Paths in it are relative to the file; here they are absolute.</summary>
    internal sealed class Scenario
    {
        private const int Version = 1;

        private Scenario(JsonFile file, string path)
        {
            var root = file.Root;
            file.RefuseUnknown(
                root, "", "version", "scene", "scripts", "schema", "programs", "program", "fields", "seed", "seconds", "deltaTime",
                "physicsStep", "schedule", "timing", "network", "threads", "jvm", "outputs");
            var version = file.Required<int>(root, "version");
            if (version != Version) throw file.Error(root["version"], "version " + version + " is not known; this player reads version " + Version);
            File = file;
            Path = path;
            var folder = System.IO.Path.GetDirectoryName(path);
            Scene = file.Required<string>(root, "scene");
            Scripts = Existing(file, root, "scripts", folder, directory: true);
            Schema = Existing(file, root, "schema", folder, directory: false);
            Programs = Existing(file, root, "programs", folder, directory: null);
            Program = file.Required<string>(root, "program");
            Fields = file.Optional(root, "fields", new JObject());
            Seed = file.Optional(root, "seed", 1UL);
            Seconds = file.Required<double>(root, "seconds");
            if (!(Seconds > 0) || Seconds > 1e9) throw file.Error(root["seconds"], "'seconds' must be greater than 0");
            DeltaTime = file.Optional(root, "deltaTime", 0.05f);
            PhysicsStep = file.Optional(root, "physicsStep", 0.02f);
            Schedule = file.Optional(root, "schedule", Schedule.Lockstep);
            Timing = ReadTiming(file, file.Optional(root, "timing", new JObject()));
            Network = ReadNetwork(file, file.Optional(root, "network", new JObject()));
            Threads = file.Optional(root, "threads", 1);
            Jvm = ReadJvm(file, file.Optional(root, "jvm", new JObject()), folder);
            var outputs = file.Optional(root, "outputs", new JObject());
            file.RefuseUnknown(outputs, "outputs.", "metrics", "replay", "pictures", "record");
            Metrics = file.Optional(outputs, "metrics", true);
            Replay = file.Optional(outputs, "replay", false);
            Pictures = file.Optional(outputs, "pictures", false);
            Record = file.Optional(outputs, "record", false);
            if (Pictures && !Replay) throw file.Error(outputs["pictures"], "'outputs.pictures' needs 'outputs.replay': pictures are taken from the replay page");
        }

        internal JsonFile File { get; }

        internal string Path { get; }

        internal string Scene { get; }

        internal string Scripts { get; }

        internal string Schema { get; }

        internal string Programs { get; }

        internal string Program { get; }

        internal JObject Fields { get; }

        internal ulong Seed { get; set; }

        internal double Seconds { get; set; }

        internal float DeltaTime { get; }

        internal float PhysicsStep { get; }

        internal Schedule Schedule { get; }

        internal RoundTiming Timing { get; }

        internal NetworkModel Network { get; }

        internal int Threads { get; }

        internal JvmSettings Jvm { get; }

        internal bool Metrics { get; }

        internal bool Replay { get; }

        internal bool Pictures { get; }

        internal bool Record { get; }

        internal static Scenario Read(string path) => new Scenario(JsonFile.Read(path), System.IO.Path.GetFullPath(path));

        private static JvmSettings ReadJvm(JsonFile file, JObject root, string folder)
        {
            var settings = new JvmSettings();
            file.RefuseUnknown(root, "jvm.", JvmSetting.All.Select(setting => setting.Key).ToArray());
            foreach (var setting in JvmSetting.All)
            {
                var token = root[setting.Key];
                if (token == null) continue;
                var value = file.Convert(token, setting.Type, "jvm." + setting.Key);
                setting.Set(settings, setting.Key == nameof(JvmSettings.home) ? System.IO.Path.Combine(folder, (string)value) : value);
            }
            foreach (var problem in settings.FindProblems()) throw file.Error(root[problem.Key] ?? root, "'jvm." + problem.Key + "': " + problem.Message);
            return settings;
        }

        private static RoundTiming ReadTiming(JsonFile file, JObject part)
        {
            file.RefuseUnknown(part, "timing.", "period", "phase", "jitter");
            var timing = new RoundTiming();
            timing.period = file.Optional(part, "period", timing.period);
            timing.phase = file.Optional(part, "phase", timing.phase);
            timing.jitter = file.Optional(part, "jitter", timing.jitter);
            return timing;
        }

        private static NetworkModel ReadNetwork(JsonFile file, JObject part)
        {
            file.RefuseUnknown(part, "network.", "loss", "lossPerMetre", "lossPerAttenuation", "delay", "jitter", "retention");
            return new NetworkModel
            {
                loss = file.Optional(part, "loss", 0.0),
                lossPerMetre = file.Optional(part, "lossPerMetre", 0.0),
                lossPerAttenuation = file.Optional(part, "lossPerAttenuation", 0.0),
                delay = file.Optional(part, "delay", 0.0),
                jitter = file.Optional(part, "jitter", 0.0),
                retention = file.Optional(part, "retention", 0.0),
            };
        }

        private static string Existing(JsonFile file, JObject root, string key, string folder, bool? directory)
        {
            var named = file.Required<string>(root, key);
            var path = System.IO.Path.GetFullPath(System.IO.Path.Combine(folder, named));
            var isDirectory = Directory.Exists(path);
            if (directory == null ? isDirectory || System.IO.File.Exists(path) : directory.Value ? isDirectory : System.IO.File.Exists(path)) return path;
            var kind = directory == null ? "jar or folder" : directory.Value ? "folder" : "file";
            throw file.Error(root[key], "'" + key + "' names no " + kind + ": " + path);
        }
    }
}
