using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests
{
    /// <summary>Tests that settings become JVM options, and that the running JVM reports their values.</summary>
    [TestFixture]
    public sealed class JvmSettingsTests
    {
        [SetUp]
        public void StartJvm()
        {
            TestJvm.Start();
        }

        [Test]
        public void Each_field_has_a_label_and_tooltip_and_numbers_have_a_range()
        {
            var fields = typeof(JvmSettings).GetFields(BindingFlags.Public | BindingFlags.Instance).Select(field => field.Name);
            Assert.That(JvmSetting.All.Select(setting => setting.Key), Is.EquivalentTo(fields));
            foreach (var setting in JvmSetting.All)
            {
                Assert.That(setting.Label, Is.Not.Empty);
                Assert.That(setting.Tooltip, Is.StringEnding("."));
                Assert.That(setting.Maximum > 0, Is.EqualTo(setting.Type == typeof(int)), setting.Key);
            }
        }

        [Test]
        public void Default_settings_select_only_the_collector_and_a_flag_can_override_it()
        {
            Assert.That(OptionsOf(new JvmSettings { cdsArchive = false }), Is.EqualTo("-XX:+UseSerialGC -XX:MaxTenuringThreshold=2"));
            Assert.That(OptionsOf(new JvmSettings { cdsArchive = false, flags = { "-XX:+UseZGC" } }), Is.EqualTo("-XX:+UseZGC"));
            Assert.That(new JvmSettings().FindProblems(), Is.Empty);
        }

        [Test]
        public void Settings_become_JVM_options_and_custom_flags_come_last()
        {
            var settings = new JvmSettings
            {
                initialHeapMb = 64, maximumHeapMb = 128, collector = JvmCollector.Z, compiler = JvmCompiler.C1, compileThreshold = 50, codeCacheMb = 48,
                cdsArchive = false, assertions = true, debugPort = 5005, repeatableMaths = true, flags = new List<string> { "-Xss2m" },
            };
            Assert.That(OptionsOf(settings), Is.EqualTo(
                "-Xms64m -Xmx128m -XX:+UseZGC -XX:TieredStopAtLevel=1 -XX:CompileThresholdScaling=0.5 -XX:ReservedCodeCacheSize=48m -ea " +
                "--add-exports=java.base/jdk.internal.vm=ALL-UNNAMED -agentlib:jdwp=transport=dt_socket,server=y,suspend=n,address=127.0.0.1:5005 " +
                "-XX:+UnlockDiagnosticVMOptions -XX:-UseLibmIntrinsic -Xss2m"));
            Assert.That(OptionsOf(new JvmSettings { cdsArchive = false, compiler = JvmCompiler.Interpreter }),
                Is.EqualTo("-XX:+UseSerialGC -XX:MaxTenuringThreshold=2 -Xint"));
        }

        [Test]
        public void Each_JVM_and_host_jar_has_its_own_class_archive_in_the_cache()
        {
            var folder = Path.Combine(Path.GetTempPath(), "collektive-cache-test");
            var words = new JvmSettings().ToLaunch(TestJvm.Home, TestJvm.HostJar, folder).Options;
            if (JvmSettings.JavaVersion(TestJvm.Home) < 19)
            {
                Assert.That(words, Is.EqualTo(new[] { "-XX:+UseSerialGC", "-XX:MaxTenuringThreshold=2" }));
                return;
            }
            Assert.That(words[2], Is.EqualTo("-XX:+AutoCreateSharedArchive"));
            Assert.That(words[3], Is.StringStarting("-XX:SharedArchiveFile=" + folder));
            Assert.That(words[4], Is.EqualTo("-Xlog:cds=off"), "output about the archive must not be shown");
            Assert.That(new JvmSettings().ToLaunch(TestJvm.Home, TestJvm.HostJar, folder).Options, Is.EqualTo(words));
            Assert.That(new JvmSettings().ToLaunch(TestJvm.Home, "/another/host.jar", folder).Options, Is.Not.EqualTo(words));
            var jar = Path.Combine(folder, "host.jar");
            File.WriteAllText(jar, "1");
            var time = new System.DateTime(2020, 1, 1);
            File.SetLastWriteTimeUtc(jar, time);
            words = new JvmSettings().ToLaunch(TestJvm.Home, jar, folder).Options;
            File.WriteAllText(jar, "2");
            File.SetLastWriteTimeUtc(jar, time);
            Assert.That(new JvmSettings().ToLaunch(TestJvm.Home, jar, folder).Options, Is.Not.EqualTo(words), "another build of the same size and time");
        }

        [Test]
        public void A_JVM_with_an_agent_has_no_class_archive()
        {
            foreach (var settings in new[] { new JvmSettings { debugPort = 5005 }, new JvmSettings { flags = { "-agentpath:/agent.so" } } })
                Assert.That(settings.ToLaunch(TestJvm.Home, TestJvm.HostJar, "/nowhere").Options, Has.None.Contains("SharedArchive"));
        }

        [Test]
        public void Truncated_and_outdated_class_archives_are_removed()
        {
            if (JvmSettings.JavaVersion(TestJvm.Home) < 19) return;
            var folder = Path.Combine(Path.GetTempPath(), "collektive-archives-" + System.Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(folder);
            var host = Path.Combine(folder, "host.jar");
            File.WriteAllText(host, "host");
            string Archive() => new JvmSettings().ToLaunch(TestJvm.Home, host, folder).Options[3].Substring("-XX:SharedArchiveFile=".Length);
            var first = Archive();
            File.WriteAllBytes(first, new byte[100]);
            Assert.That(Archive(), Is.EqualTo(first));
            Assert.That(File.Exists(first), Is.False, "a truncated archive, which a killed JVM leaves, must be removed");
            File.WriteAllText(first, "archive");
            var other = Path.Combine(folder, "classes-of-another-editor.jsa");
            File.WriteAllText(other, "archive");
            Archive();
            Assert.That(File.Exists(first), Is.True);
            File.WriteAllText(host, "another host");
            Assert.That(Archive(), Is.Not.EqualTo(first));
            Assert.That((File.Exists(first), File.Exists(other)), Is.EqualTo((false, true)));
            Directory.Delete(folder, true);
        }

        [Test]
        public void Without_a_writable_cache_the_class_archive_is_disabled_with_a_note()
        {
            var launch = new JvmSettings().ToLaunch(TestJvm.Home, TestJvm.HostJar, "/proc/nobody/Collektive");
            Assert.That(launch.Options, Is.EqualTo(new[] { "-XX:+UseSerialGC", "-XX:MaxTenuringThreshold=2" }));
            if (JvmSettings.JavaVersion(TestJvm.Home) >= 19) Assert.That(launch.Note, Is.StringContaining("/proc/nobody/Collektive"));
        }

        [TestCase("initialHeapMb", 7)]
        [TestCase("maximumHeapMb", -1)]
        [TestCase("maximumHeapMb", 15)]
        [TestCase("codeCacheMb", 5000)]
        [TestCase("compileThreshold", 0)]
        [TestCase("debugPort", 80)]
        [TestCase("debugPort", 70000)]
        public void A_number_out_of_range_is_reported_for_its_field(string key, int value)
        {
            var settings = new JvmSettings();
            JvmSetting.Find(key).Set(settings, value);
            var problem = settings.FindProblems().Single();
            Assert.That(problem.Key, Is.EqualTo(key));
            Assert.That(problem.Message, Is.StringContaining("is " + value + ": it must be "));
        }

        [Test]
        public void Inconsistent_settings_are_reported()
        {
            Assert.That(Problem(new JvmSettings { initialHeapMb = 200, maximumHeapMb = 100 }, "initialHeapMb"), Is.StringContaining("200 MB"));
            Assert.That(Problem(new JvmSettings { location = JvmLocation.Folder }, "home"), Is.StringContaining("choose"));
            Assert.That(Problem(new JvmSettings { flags = { "" } }, "flags"), Is.StringContaining("empty"));
            Assert.That(Problem(new JvmSettings { flags = { "-Xss2m -Xint" } }, "flags"), Is.StringContaining("several flags"));
            Assert.That(Problem(new JvmSettings { collector = (JvmCollector)42 }, "collector"), Is.StringContaining("42"));
        }

        [TestCase("-XX:+NoSuchThing", "flags", "NoSuchThing")]
        [TestCase("-XX:+ExitOnOutOfMemoryError", "flags", "ends the whole process")]
        [TestCase("-XX:-UseSignalChaining", "flags", "signal handlers")]
        [TestCase("-agentlib:jdwp=transport=dt_socket,server=y,suspend=n,address=*:5005", "flags", "address=127.0.0.1")]
        [TestCase("-XX:+UseParallelGC", "collector", "ollectors selected")]
        public void An_unsupported_flag_is_reported_for_its_field_with_the_reason(string flag, string key, string reason)
        {
            var settings = TestJvm.Settings;
            settings.flags.Add(flag);
            var report = JvmReport.Of(settings, TestJvm.Launch);
            Assert.That(report.IsValid, Is.False);
            Assert.That(report.Problem(JvmSetting.Find(key)), Is.StringContaining(reason));
        }

        [Test]
        public void A_heap_that_cannot_be_reserved_is_reported_only_for_the_heap_settings()
        {
            var report = JvmReport.Of(new JvmSettings { initialHeapMb = 1 << 20, maximumHeapMb = 1 << 20, cdsArchive = false }, TestJvm.Launch);
            Assert.That(report.IsValid, Is.False);
            var problems = JvmSetting.All.Where(setting => report.Problem(setting).Length > 0).Select(setting => setting.Key).ToArray();
            Assert.That(problems, Is.SubsetOf(new[] { "initialHeapMb", "maximumHeapMb" }));
        }

        [Test]
        public void A_debug_port_in_use_is_reported()
        {
            var other = new System.Net.Sockets.TcpListener(System.Net.IPAddress.Loopback, 0);
            other.Start();
            try
            {
                var settings = TestJvm.Settings;
                settings.debugPort = ((System.Net.IPEndPoint)other.LocalEndpoint).Port;
                var report = JvmReport.Of(settings, TestJvm.Launch);
                Assert.That(report.Problem(JvmSetting.Find("debugPort")), Is.Not.Empty);
            }
            finally
            {
                other.Stop();
            }
        }

        [Test]
        public void A_path_of_the_host_with_an_emoji_is_refused()
        {
            Installation.HostJar = "/nowhere/\ud83d\ude80/collektive-host.jar";
            Installation.JavaHome = TestJvm.Home;
            Assert.That(
                Assert.Throws<BridgeException>(() => Installation.ToLaunch(TestJvm.Settings)).Message,
                Is.StringContaining("cannot load classes from /nowhere/\ud83d\ude80/collektive-host.jar: its path contains an emoji"));
            Installation.HostJar = TestJvm.HostJar;
        }

        [Test]
        public void The_JVM_is_searched_at_the_configured_location()
        {
            Installation.HostJar = TestJvm.HostJar;
            Installation.JavaHome = TestJvm.Home;
            Assert.That(Installation.ToLaunch(TestJvm.Settings).Home, Is.EqualTo(TestJvm.Home));
            var report = JvmReport.Of(new JvmSettings { location = JvmLocation.Folder, home = "/nowhere/jdk" }, Installation.ToLaunch);
            Assert.That(report.Problem(JvmSetting.Find("home")), Is.StringContaining("/nowhere/jdk"));
            report = JvmReport.Of(new JvmSettings { location = JvmLocation.Bundled }, Installation.ToLaunch);
            Assert.That(report.Problem(JvmSetting.Find("location")), Is.StringContaining("install org.collektive.unity.jvm.linux-x64"));
        }

        [Test]
        public void Each_setting_reports_its_effective_value()
        {
            var report = JvmReport.Of(TestJvm.Settings, TestJvm.Launch);
            Assert.That(report.IsValid, Is.True);
            Assert.That(report.Notice, Is.Empty);
            Func<string, string> effective = key => report.Effective(JvmSetting.Find(key));
            Assert.That(effective("maximumHeapMb"), Is.EqualTo("256 MB"));
            Assert.That(effective("collector"), Is.EqualTo("Serial"));
            Assert.That(effective("compiler"), Is.EqualTo("Tiered"));
            Assert.That(effective("compileThreshold"), Is.EqualTo("100 %"));
            Assert.That(effective("debugPort"), Is.EqualTo("off"));
            Assert.That(effective("assertions"), Is.EqualTo("off"));
            Assert.That(effective("repeatableMaths"), Is.EqualTo("off"));
            Assert.That(effective("location"), Is.EqualTo(TestJvm.Home));
            Assert.That(effective("initialHeapMb"), Is.StringEnding(" MB"));
            Assert.That(effective("placement"), Is.StringStarting(TestJvm.Placement.ToString()));
            Assert.That(effective("flags"), Is.EqualTo("-Xmx256m -XX:+UseSerialGC"));
        }

        [Test]
        public void Changed_settings_report_the_required_restart_and_the_running_options()
        {
            var settings = TestJvm.Settings;
            settings.maximumHeapMb = 512;
            var report = JvmReport.Of(settings, TestJvm.Launch);
            Assert.That(report.IsValid, Is.True);
            Assert.That(report.Notice, Is.StringContaining(TestJvm.WhenChangesTakeEffect));
            Assert.That(report.Notice, Is.StringContaining("-Xmx256m"));
            Assert.That(report.Effective(JvmSetting.Find("maximumHeapMb")), Is.EqualTo("256 MB"));
        }

        [Test]
        public void A_new_settings_asset_is_valid()
        {
            Assert.That(ScriptableObject.CreateInstance<JvmSettingsAsset>().settings.FindProblems(), Is.Empty);
        }

        private static string OptionsOf(JvmSettings settings) => string.Join(" ", settings.ToLaunch(TestJvm.Home, TestJvm.HostJar, "unused").Options);

        private static string Problem(JvmSettings settings, string key) => settings.FindProblems().Single(problem => problem.Key == key).Message;
    }
}
