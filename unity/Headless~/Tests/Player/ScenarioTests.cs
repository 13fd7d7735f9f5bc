using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Threading;
using Collektive.Bridge;
using Collektive.Unity;
using Newtonsoft.Json.Linq;
using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Player
{
    /// <summary>Tests that settings in the inspector are keys of scenario files and manifests, without separate code for each setting.</summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class ScenarioTests
    {
        private static readonly string[] RenamedKeys = { "schema", "jars", "libraries", "defaultProgram", "record", "stopAfter", "jvm" };

        private readonly string folder = Path.Combine(Path.GetTempPath(), "collektive-scenario-" + Guid.NewGuid());

        private static readonly string[] Paths = { nameof(SimulationSettings.runtimeJars), nameof(SimulationSettings.runtimePlugin) };

        [SetUp]
        public void MakeFolder()
        {
            Directory.CreateDirectory(folder);
            File.WriteAllText(Path.Combine(folder, "user.fbs"), "");
        }

        [TearDown]
        public void RemoveFolder() => Directory.Delete(folder, true);

        [Test]
        public void Each_simulation_setting_without_an_equivalent_is_a_scenario_key()
        {
            var root = Minimal();
            var other = new Dictionary<string, JToken>();
            foreach (var field in typeof(SimulationSettings).GetFields(BindingFlags.Public | BindingFlags.Instance))
            {
                if (Array.IndexOf(RenamedKeys, field.Name) < 0) other.Add(field.Name, Vary(field.GetValue(new SimulationSettings())));
            }
            Assert.That(other.Keys, Has.Member("threads").And.Member("network").And.Member("stepLimitMs"));
            foreach (var setting in other) root[setting.Key] = setting.Value;
            // These keys cannot be changed, because their paths must exist.
            foreach (var key in Paths) other.Remove(key);
            root[Paths[0]] = ".";
            root[Paths[1]] = "user.fbs";
            var settings = new SimulationSettings();
            Read(root).CopyTo(settings);
            foreach (var setting in other)
            {
                var actual = typeof(SimulationSettings).GetField(setting.Key).GetValue(settings);
                Assert.That(Text(JsonFile.Token(actual) ?? JObject.FromObject(actual)), Is.EqualTo(Text(setting.Value)), setting.Key);
            }
        }

        [Test]
        public void A_scenario_with_all_defaults_round_trips()
        {
            var once = Read(Minimal()).ToJson(new JObject());
            foreach (var key in new[] { "seed", "deltaTime", "timing", "network", "threads", "stepLimitMs" }) Assert.That(once[key], Is.Not.Null, key);
            Assert.That(Text(Read(once).ToJson(new JObject())), Is.EqualTo(Text(once)));
        }

        [Test]
        public void An_interval_may_be_equal_to_a_delta_time_with_more_digits_than_a_float()
        {
            var root = Minimal();
            root["deltaTime"] = 1 / 60.0;
            root["outputs"] = new JObject(new JProperty("interval", 1 / 60.0));
            Assert.That(Read(root).Interval, Is.EqualTo(0.01666667));
        }

        [TestCase("network", "{\"loss\": 0.1, \"los\": 0.1}", "unknown key 'network.los'; known here: loss, lossPerMetre")]
        [TestCase("timing", "{\"period\": \"long\"}", "'timing.period' is \"long\"; it must be of type number")]
        [TestCase("network", "0.1", "'network' is 0.1; it must be of type object; its keys are: loss, ")]
        [TestCase("outputs", "{\"nodes\": [\"position\"]}", "'outputs.nodes' is [\"position\"]; it must be of type object; its keys are: fields, interval")]
        [TestCase("threads", "2.5", "'threads' is 2.5; it must be of type whole number")]
        [TestCase("stopAfter", "1", "unknown key 'stopAfter'; known here: version, scene")]
        public void Errors_name_their_position(string key, string value, string message)
        {
            var root = Minimal();
            root[key] = JToken.Parse(value);
            Assert.That(Assert.Throws<ScenarioException>(() => Read(root)).Message, Is.StringContaining(message));
        }

        [TestCase("parameters", "{\"p\": 3}", "'parameters.p' is 3; it must be of type object")]
        [TestCase("parameters", "{\"p\": {\"width\": [1]}}", "'parameters.p.width' is [1]; it must be of type string")]
        [TestCase("converged", "{\"error\": {\"seconds\": 1}}", "'converged.error' needs 'from', 'to' or both")]
        [TestCase("converged", "{\"error\": {\"from\": 2, \"to\": 1}}", "'converged.error': 'from' is greater than 'to'")]
        [TestCase("stopWhenConverged", "true", "'stopWhenConverged' needs 'converged'")]
        [TestCase("outputs", "{\"interval\": 0.01}", "'outputs.interval' is 0.01: it must be at least 'deltaTime'")]
        [TestCase("outputs", "{\"interval\": 1e9}", "'outputs.interval' is 1E+09: it must be at most 1E+08 s")]
        [TestCase("outputs", "{\"nodes\": {\"fields\": [\"a\", \"b\", \"a\"]}}", "'outputs.nodes.fields' contains 'a' twice")]
        [TestCase("outputs", "{\"nodes\": {\"field\": []}}", "unknown key 'outputs.nodes.field'; known here: fields, interval")]
        public void Errors_in_experiment_keys_name_their_position(string key, string value, string message) =>
            Errors_name_their_position(key, value, message);

        [Test]
        public void Keys_can_be_set_on_the_command_line()
        {
            var root = Minimal();
            root["network"] = JObject.Parse("{\"loss\": 0.5, \"delay\": 2}");
            var scenario = Read(
                root, "network.loss=0.25", "timing.period=0.5", "program=other", "parameters.a.b.width=3", "parameters.a.b.wide=true",
                "parameters.a.b.version=1.0", "jvm.maximumHeapMb=100", "outputs.interval=2", "seed=18446744073709551615");
            Assert.That(scenario.Settings.network.loss, Is.EqualTo(0.25));
            Assert.That(scenario.Settings.network.delay, Is.EqualTo(2));
            Assert.That(scenario.Settings.timing.period, Is.EqualTo(0.5f));
            Assert.That(scenario.Settings.program, Is.EqualTo("other"));
            Assert.That(scenario.Settings.seed, Is.EqualTo(ulong.MaxValue));
            Assert.That(scenario.Jvm.maximumHeapMb, Is.EqualTo(100));
            Assert.That(scenario.Interval, Is.EqualTo(2));
            var set = scenario.Settings.ProgramParameters["a.b"];
            Assert.That(set.ConvertAll(parameter => parameter.name + "=" + parameter.value), Is.EqualTo(new[] { "width=3", "wide=true", "version=1.0" }));
        }

        [TestCase("nodes=3", "nodes=3")]
        [TestCase("fields.nodes=3", "nodes=3")]
        public void Any_other_name_sets_a_field_of_the_scene_builder(string text, string field)
        {
            Assert.That(Assignment.Parse(text, out var found), Is.Null);
            Assert.That(found, Is.EqualTo(field));
        }

        [TestCase("area={\"size\": 1, \"depth\": 2}", "area.size=3", "{\"area\":{\"size\":3,\"depth\":2}}", "")]
        [TestCase("area.size=3", "area={\"depth\": 2}", "{\"area\":{\"size\":3}}", "area={\"depth\": 2}")]
        [TestCase("nodes=3", "fields={\"area\": 1}", "{\"area\":1}", "")]
        [TestCase("nodes=3", "nodesOf.a=1", "{\"nodesOf\":{\"a\":1}}", "nodes=3")]
        public void Later_assignments_of_fields_override_earlier_ones(string first, string second, string fields, string left)
        {
            var options = Options.Parse(new[] { "plan", "scenario.json", "--set", first, "--set", second });
            Assert.That(Text(ReadText(Minimal().ToString(), options.Assignments).Fields), Is.EqualTo(fields));
            Assert.That(string.Join(" ", options.FieldAssignments), Is.EqualTo(left));
        }

        [Test]
        public void All_fields_of_a_scene_can_be_read_from_a_manifest()
        {
            var root = Minimal();
            root["fields"] = SceneFields.Get(WithFields(Minimal()));
            Assert.That(Text(root["fields"]), Is.EqualTo(
                "{\"count\":3000000000,\"range\":\"Infinity\",\"none\":\"NaN\",\"zone\":{\"radius\":9.0,\"count\":1}}"));
            root["fields"]["count"] = 4000000000;
            root["fields"]["zone"]["radius"] = 8;
            Assert.That(Text(SceneFields.Get(WithFields(root))), Is.EqualTo(Text(root["fields"]).Replace("8,", "8.0,")));
        }

        [TestCase("upper", "\"A\"")]
        [TestCase("hidden", "1")]
        [TestCase("flags", null)]
        [TestCase("names", null)]
        [TestCase("zones", null)]
        [TestCase("limit", null)]
        [TestCase("distinct", null)]
        [TestCase("zone", "{\"radius\":1.0,\"count\":1}")]
        [TestCase("ring", "{\"number\":1}")]
        public void Values_that_a_scenario_cannot_contain_are_omitted(string field, string json)
        {
            var root = Minimal();
            root["fields"] = JObject.Parse("{\"upper\": \"A\"}");
            var fields = SceneFields.Get(WithFields<UnusualScene>(root));
            Assert.That(fields[field] is JToken value ? Text(value) : null, Is.EqualTo(json));
            root["fields"] = fields;
            Assert.That(Text(SceneFields.Get(WithFields<UnusualScene>(root))), Is.EqualTo(Text(fields)));
        }

        [TestCase("zone={\"count\": 3}", "{\"radius\":9.0,\"count\":3}")]
        [TestCase("zone.count=3", "{\"radius\":8.0,\"count\":3}")]
        public void Fields_of_an_object_that_are_not_set_keep_the_values_of_the_scene(string assignment, string zone)
        {
            var root = Minimal();
            root["fields"] = JObject.Parse("{\"zone\": {\"radius\": 8}}");
            var options = Options.Parse(new[] { "plan", "scenario.json", "--set", assignment });
            Assert.That(Text(SceneFields.Get(WithFields(root, options))["zone"]), Is.EqualTo(zone));
        }

        [Test]
        public void A_shared_object_that_was_set_is_the_same_in_a_repetition()
        {
            var root = Minimal();
            root["fields"] = JObject.Parse("{\"zone\": {\"radius\": 8}, \"others\": [{\"count\": 2}]}");
            var fields = SceneFields.Get(WithFields<SharedZoneScene>(root));
            // The order of fields is that of the runtime.
            var expected = JObject.Parse("{'others': [{'radius': 1.0, 'count': 2}], 'zone': {'radius': 8.0, 'count': 1}}");
            Assert.That(JToken.DeepEquals(fields, expected), fields.ToString());
            root["fields"] = fields;
            var repeated = WithFields<SharedZoneScene>(root);
            Assert.That(repeated.zone.radius, Is.EqualTo(8));
            Assert.That(repeated.zones[0], Is.SameAs(repeated.zone));
        }

        [Test]
        public void Numbers_in_errors_have_a_decimal_point()
        {
            var culture = Thread.CurrentThread.CurrentCulture;
            try
            {
                Thread.CurrentThread.CurrentCulture = new CultureInfo("de-DE");
                Assert.That(Assert.Throws<ScenarioException>(() => Read(Minimal()).Override(null, -0.5)).Message, Is.StringStarting("--seconds -0.5: "));
            }
            finally
            {
                Thread.CurrentThread.CurrentCulture = culture;
            }
        }

        [TestCase("threads=010", "'threads' is \"010\"; it must be of type whole number")]
        [TestCase("threads=0x10", "'threads' is \"0x10\"; it must be of type whole number")]
        [TestCase("network.loss=0,5", "'network.loss' is \"0,5\"; it must be of type number")]
        [TestCase("deltaTime=1e39", "'deltaTime' is 1E+39; it must be between -3.4E+38 and 3.4E+38")]
        [TestCase("threads=3000000000", "'threads' is 3000000000; it must be between -2147483648 and 2147483647")]
        [TestCase("network.los=1", "unknown key 'network.los'")]
        [TestCase("seconds.x=1", "'seconds.x' cannot be set: 'seconds' is not an object")]
        [TestCase("threads=many", "'threads' is \"many\"; it must be of type whole number")]
        [TestCase("threads", "--set threads: write it as --set KEY=VALUE")]
        public void Invalid_assignments_are_reported(string assignment, string message) =>
            Assert.That(Assert.Throws<ScenarioException>(() => Read(Minimal(), assignment)).Message, Is.StringContaining(message));

        [TestCase("LINE", "RING", null)]
        [TestCase("LINE", "CIRCLE", "must be one of LINE, RING")]
        [TestCase("2", "-1e3", null)]
        [TestCase("2", "5f", null)]
        [TestCase("2", "1e400", null)]
        [TestCase("2", "0x1p3", null)]
        [TestCase("2", "0xZZ", "must be a number")]
        [TestCase("2", "NaNd", "must be a number")]
        [TestCase("2", "many", "must be a number")]
        [TestCase("2d", "many", "must be a number")]
        [TestCase("text", null, "must have a value")]
        public void A_live_run_refuses_values_of_parameters_that_would_end_it(string byDefault, string value, string problem)
        {
            var parameter = new ProgramParameter("shape", byDefault, "", byDefault == "LINE" ? new[] { "LINE", "RING" } : new string[0]);
            Assert.That(LiveRun.FindProblem(parameter, value), Is.EqualTo(problem));
        }

        [TestCase(5, null)]
        [TestCase(9, 0.0)]
        public void A_metric_does_not_converge_before_the_first_round(double to, double? expected)
        {
            var root = Minimal();
            root["converged"] = new JObject(new JProperty("error", new JObject(new JProperty("to", to))));
            var convergence = Read(root).Convergence;
            convergence.Bind(new[] { "error" });
            convergence.Add(0, new[] { 4.0 });
            Assert.That(convergence.IsComplete, Is.False);
            convergence.Add(1, new[] { 8.0 });
            Assert.That((double?)convergence.Times()["error"], Is.EqualTo(expected));
        }

        [TestCase(1, null)]
        [TestCase(2, 3.0)]
        public void A_metric_converges_when_it_stays_in_its_band(double to, double? expected)
        {
            var root = Minimal();
            root["converged"] = new JObject(new JProperty("error", new JObject(new JProperty("to", to), new JProperty("seconds", 2))));
            var convergence = Read(root).Convergence;
            convergence.Bind(new[] { "other", "error" });
            var values = new[] { 9.0, 2, 8, 1, 2, 1.5, 7 };
            for (var i = 0; i < values.Length; i++) convergence.Add(i, new[] { 0, values[i] });
            Assert.That((double?)convergence.Times()["error"], Is.EqualTo(expected));
            Assert.That(convergence.IsComplete, Is.EqualTo(expected != null));
            Assert.That(Assert.Throws<ScenarioException>(() => convergence.Bind(new[] { "other" })).Message, Is.StringContaining("the metrics "
                + "are: other"));
        }

        [TestCase(0.0333333, 30, 49.99995)]
        [TestCase(0.033333, 30, 49.9995)]
        [TestCase(0.016667, 60, 50.001)]
        [TestCase(0.0083333, 120, 49.9998)]
        public void A_metric_converges_after_just_the_period_with_rounded_ticks(double deltaTime, int ticksPerRow, double expected)
        {
            var root = Minimal();
            root["converged"] = new JObject(new JProperty("error", new JObject(new JProperty("to", 1), new JProperty("seconds", 10))));
            var convergence = Read(root).Convergence;
            convergence.Bind(new[] { "error" });
            for (var row = 0; row <= 60; row++) convergence.Add(row * ticksPerRow * deltaTime, new[] { row >= 50 ? 0.0 : 2 });
            Assert.That((double?)convergence.Times()["error"], Is.EqualTo(expected));
        }

        [TestCase(0.003, null)]
        [TestCase(0.002, 0.002)]
        public void A_long_period_of_convergence_lacks_no_tick(double start, double? expected)
        {
            var root = Minimal();
            root["deltaTime"] = 0.001;
            root["converged"] = new JObject(new JProperty("error", new JObject(new JProperty("to", 1), new JProperty("seconds", 100))));
            var convergence = Read(root).Convergence;
            convergence.Bind(new[] { "error" });
            convergence.Add(start, new[] { 0.0 });
            convergence.Add(100.002, new[] { 0.0 });
            Assert.That((double?)convergence.Times()["error"], Is.EqualTo(expected));
        }

        [Test]
        public void A_time_of_convergence_is_rounded_as_in_the_table()
        {
            var root = Minimal();
            root["converged"] = new JObject(new JProperty("error", new JObject(new JProperty("to", 1))));
            var convergence = Read(root).Convergence;
            convergence.Bind(new[] { "error" });
            convergence.Add(1.6666665, new[] { 0.0 });
            Assert.That((double)convergence.Times()["error"], Is.EqualTo(double.Parse(1.6666665.ToString("0.######"))));
        }

        [TestCase("-Xmx1g")]
        [TestCase("-XX:+UseZGC")]
        [TestCase("-XX:-OmitStackTraceInFastThrow")]
        [TestCase("-XX:CompileThresholdScaling=0.5")]
        [TestCase("-XX:MaxGCPauseMillis=5")]
        [TestCase("-XX:NativeMemoryTracking=summary")]
        [TestCase("-Xlog:gc*=debug")]
        [TestCase("-Xlog:gc+heap,safepoint:stderr:uptime,tags")]
        [TestCase("-verbose:gc")]
        [TestCase("-ea:org.example...")]
        [TestCase("-Dexample.size=3")]
        [TestCase("--add-opens=java.base/java.lang=ALL-UNNAMED")]
        public void A_harmless_flag_is_accepted(string flag) => Assert.That(ReadWith(flag, false).Jvm.flags, Has.Member(flag));

        [TestCase("-Xlog:gc:file=/home/me/thesis.tex")]
        [TestCase("-Xlog:gc:/home/me/thesis.tex")]
        [TestCase("-Xlog:gc:stdout/../x")]
        [TestCase("-Xlog::file=x")]
        [TestCase("-Xloggc:x")]
        [TestCase("-XX:LogFile=x")]
        [TestCase("-XX:LogFile=7")]
        [TestCase("-XX:+LogVMOutput")]
        [TestCase("-XX:+LogCompilation")]
        [TestCase("-XX:DumpLoadedClassList=x")]
        [TestCase("-Xshare:dump")]
        [TestCase("-XX:SharedArchiveFile=x")]
        [TestCase("-XX:ArchiveClassesAtExit=x")]
        [TestCase("-XX:+DynamicDumpSharedSpaces")]
        [TestCase("-XX:+AutoCreateSharedArchive")]
        [TestCase("-XX:AOTCacheOutput=x")]
        [TestCase("-XX:AOTConfiguration=x")]
        [TestCase("-XX:AOTCache=x")]
        [TestCase("-XX:StartFlightRecording")]
        [TestCase("-XX:StartFlightRecording=filename=x")]
        [TestCase("-XX:FlightRecorderOptions=repository=x")]
        [TestCase("-XX:+HeapDumpOnOutOfMemoryError")]
        [TestCase("-XX:HeapDumpPath=x")]
        [TestCase("-XX:ErrorFile=x")]
        [TestCase("-XX:ReplayDataFile=x")]
        [TestCase("-XX:CompileCommandFile=x")]
        [TestCase("-XX:CompilerDirectivesFile=x")]
        [TestCase("-XX:+PerfDataSaveToFile")]
        [TestCase("-XX:PerfDataSaveFile=x")]
        [TestCase("-XX:+DumpPerfMapAtExit")]
        [TestCase("-XX:AllocateHeapAt=x")]
        [TestCase("-XX:+ManagementServer")]
        [TestCase("-XX:+StartAttachListener")]
        [TestCase("-XX:+EnableJVMCI")]
        [TestCase("-XX:+PauseAtStartup")]
        [TestCase("-Djdk.internal.lambda.dumpProxyClasses=x")]
        [TestCase("-Djava.library.path=x")]
        [TestCase("-Dcom.sun.management.jmxremote.port=1")]
        [TestCase("-agentlib:jdwp=transport=dt_socket,server=y,suspend=n,address=127.0.0.1:5005")]
        [TestCase("-agentpath:/tmp/x.so")]
        [TestCase("-javaagent:x.jar")]
        [TestCase("-Xrunhprof")]
        [TestCase("-Xbootclasspath/a:x.jar")]
        [TestCase("--patch-module=java.base=x")]
        [TestCase("--module-path=x")]
        [TestCase("-Xmx1g\n-XX:LogFile=x")]
        [TestCase("-XX:SomethingOfTheNextRelease=x")]
        [TestCase("-XX:MallocLimit=50m")]
        public void A_flag_that_may_write_files_open_ports_or_load_code_needs_trust(string flag)
        {
            var message = Assert.Throws<ScenarioException>(() => ReadWith(flag, false)).Message;
            Assert.That(message, Is.StringContaining("scenario.json:"));
            Assert.That(message, Is.StringContaining("'jvm.flags[1]', " + flag + ", is refused"));
            Assert.That(message, Is.StringContaining("--trust-jvm"));
            Assert.That(ReadWith(flag, true).Jvm.flags, Has.Member(flag));
        }

        [TestCase("Automatic", false)]
        [TestCase("JavaHome", false)]
        [TestCase("Folder", true)]
        public void A_folder_of_the_JVM_needs_the_location_that_reads_it(string location, bool isRead)
        {
            var root = Minimal();
            root["jvm"] = new JObject(new JProperty("home", "/jdk"), new JProperty("location", location));
            if (isRead) Assert.That(Read(root, true).Jvm.home, Is.EqualTo("/jdk"));
            else Assert.That(Assert.Throws<ScenarioException>(() => Read(root, true)).Message, Is.StringContaining("needs the 'jvm.location' Folder"));
        }

        [TestCase("010")]
        [TestCase("-010")]
        [TestCase("0x10")]
        [TestCase("1.")]
        public void Invalid_JSON_numbers_are_rejected_with_their_line(string number)
        {
            var text = Minimal().ToString().Replace("\"seconds\": 1", "\"seconds\": 1, // it's 007\n\"threads\": " + number);
            var line = Array.FindIndex(text.Split('\n'), each => each.Contains("threads")) + 1;
            var message = Assert.Throws<ScenarioException>(() => ReadText(text)).Message;
            Assert.That(message, Is.StringContaining("scenario.json:" + line + ": not valid JSON: '" + number + "' is not a JSON number"));
        }

        [TestCase("scripts", "'scripts'")]
        [TestCase("schema", "'schema'")]
        [TestCase("programs", "'programs'")]
        [TestCase("data", "'data'")]
        [TestCase("home", "'jvm.home'")]
        public void A_path_with_an_escaped_null_character_is_rejected(string key, string name)
        {
            var root = Minimal();
            if (key == "home") root["jvm"] = new JObject(new JProperty("home", "\0"));
            else root[key] = "\0";
            Assert.That(Assert.Throws<ScenarioException>(() => Read(root)).Message, Is.StringContaining(name + " contains a null character"));
        }

        [Test]
        public void A_null_character_is_not_JSON()
        {
            var message = Assert.Throws<ScenarioException>(() => ReadText(Minimal().ToString().Replace("\"seconds\": 1", "\"seconds\": 1\0"))).Message;
            Assert.That(message, Is.StringMatching(@"scenario\.json:\d+: not valid JSON: the file contains a null character"));
        }

        [TestCase("2.5e+3", 2500)]
        [TestCase("-0.5E-1 /* 010 */", -0.05)]
        [TestCase("/* \n\r\r\n */ 3.439885336832876e-301", 3.439885336832876e-301)]
        [TestCase("100000000000000000000000", 1e23)]
        [TestCase("-0.0", -0.0)]
        public void Valid_JSON_numbers_are_read_exactly(string text, double number)
        {
            var file = Read(Minimal()).File;
            var read = (double)file.Convert(JsonFile.Parse(text), typeof(double), "");
            Assert.That(BitConverter.DoubleToInt64Bits(read), Is.EqualTo(BitConverter.DoubleToInt64Bits(number)));
            var again = (double)file.Convert(JsonFile.Parse(JsonFile.Text(new JValue(read))), typeof(double), "");
            Assert.That(BitConverter.DoubleToInt64Bits(again), Is.EqualTo(BitConverter.DoubleToInt64Bits(number)));
        }

        [TestCase(0.01f, 10000)]
        [TestCase(0.02f, 5000)]
        [TestCase(0.04f, 2500)]
        [TestCase(0.1f, 1000)]
        [TestCase(0.03f, 3334)]
        [TestCase(1 / 3f, 300)]
        [TestCase(0.016667f, 6000)]
        public void One_row_is_due_per_interval_for_any_tick_length(float deltaTime, int ticks)
        {
            var rows = new RowSchedule(1, deltaTime);
            var count = 0;
            for (var tick = 1; tick <= ticks; tick++)
            {
                if (!rows.IsDue(tick)) continue;
                count++;
                Assert.That(tick * (decimal)deltaTime, Is.InRange(count * 0.999999m, count + (decimal)deltaTime * 0.999m));
                rows.Advance();
            }
            Assert.That(count, Is.EqualTo(100));
        }

        [TestCase("home", "{\"location\": \"Folder\", \"home\": \"jdk\"}")]
        [TestCase("debugPort", "{\"debugPort\": 5005}")]
        public void A_JVM_setting_that_opens_ports_or_selects_another_JVM_needs_trust(string key, string settings)
        {
            var root = Minimal();
            root["jvm"] = JObject.Parse(settings);
            var message = Assert.Throws<ScenarioException>(() => Read(root)).Message;
            Assert.That(message, Is.StringContaining("'jvm." + key + "' is refused").And.StringContaining("--trust-jvm"));
            Assert.That(Read(root, true), Is.Not.Null);
        }

        private Scenario ReadWith(string flag, bool trustsJvm)
        {
            var root = Minimal();
            root["jvm"] = new JObject(new JProperty("flags", new JArray("-Xss2m", flag)));
            return Read(root, trustsJvm);
        }

        /// <summary>Returns a scene whose fields were set by a scenario and the command line.</summary>
        private SceneBuilder WithFields(JObject root, Options options = null) => WithFields<ZoneScene>(root, options);

        private T WithFields<T>(JObject root, Options options = null)
            where T : SceneBuilder
        {
            var holder = new GameObject("Scene");
            holder.SetActive(false);
            var scene = holder.AddComponent<T>();
            var assignments = options?.Assignments ?? new List<Assignment>();
            SceneFields.Set(scene, ReadText(root.ToString(), assignments), options?.FieldAssignments ?? new List<string>());
            UnityEngine.Object.DestroyImmediate(holder);
            return scene;
        }

        private Scenario Read(JObject root, bool trustsJvm)
        {
            var path = Path.Combine(folder, "scenario.json");
            File.WriteAllText(path, root.ToString());
            return Scenario.Read(path, null, trustsJvm);
        }

        private Scenario Read(JObject root, params string[] assignments) => ReadText(root.ToString(), assignments);

        private Scenario ReadText(string text, params string[] assignments) =>
            ReadText(text, Array.ConvertAll(assignments, each => Assignment.Parse(each, out _)));

        private Scenario ReadText(string text, IEnumerable<Assignment> assignments)
        {
            var path = Path.Combine(folder, "scenario.json");
            File.WriteAllText(path, text);
            return Scenario.Read(path, null, false, assignments.ToArray());
        }

        private static JObject Minimal() => JObject.Parse(
            "{\"version\": 1, \"scene\": \"Scene\", \"scripts\": \".\", \"schema\": \"user.fbs\", \"programs\": \".\", \"program\": \"p\", \"seconds\": 1}");

        /// <summary>Returns a value that differs from the given default.</summary>
        private static JToken Vary(object value)
        {
            switch (value)
            {
                case string text: return text + "other";
                case ulong number: return new JValue((long)number + 1);
                case int number: return number + 1;
                case float number: return number / 2;
                case double number: return number + 0.5;
                case Enum _: return Enum.GetNames(value.GetType())[1];
            }
            var parts = new JObject();
            foreach (var field in value.GetType().GetFields(BindingFlags.Public | BindingFlags.Instance)) parts.Add(field.Name, Vary(field.GetValue(value)));
            return parts;
        }

        private static string Text(JToken token) => token.ToString(Newtonsoft.Json.Formatting.None);

        /// <summary>A scene with fields of different types.</summary>
        public sealed class ZoneScene : SceneBuilder
        {
            public long count = 3000000000;
            public float range = float.PositiveInfinity;
            public double none = double.NaN;
            public Zone zone = new Zone { radius = 9 };

            protected override void Build(SimulationManager manager)
            {
            }
        }

        [Flags]
        public enum Letters
        {
            None = 0,
            a = 1,
            A = 2,
        }

        /// <summary>A scene with a list whose object is also the value of a field.</summary>
        public sealed class SharedZoneScene : SceneBuilder
        {
            public List<Zone> zones = new List<Zone> { new Zone { radius = 9 } };
            public List<Zone> others = new List<Zone>();
            public Zone zone;

            public SharedZoneScene() => zone = zones[0];

            protected override void Build(SimulationManager manager)
            {
            }
        }

        public class HiddenFieldScene : SceneBuilder
        {
            public int hidden = 2;

            protected override void Build(SimulationManager manager)
            {
            }
        }

        public sealed class UnusualScene : HiddenFieldScene
        {
            public new int hidden = 1;
            public Letters upper;
            public Letters flags = Letters.a | Letters.A;
            public string[] names = { null };
            public List<Zone> zones = new List<Zone> { new NamedZone() };
            public int? limit = 3;
            public HashSet<string> distinct = new HashSet<string> { "a" };
            public Zone zone = new NamedZone();
            public Ring ring = new Ring();
        }

        public class Ring
        {
            public int number = 1;
            public Ring next;

            public Ring() => next = this;
        }

        public sealed class NamedZone : Zone
        {
            public string name = "hall";
        }

        public class Zone
        {
            public float radius = 1;
            public int count = 1;
        }
    }
}
