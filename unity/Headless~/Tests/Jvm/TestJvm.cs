using System;
using Collektive.Bridge;
using probe;

namespace Collektive.Headless.Tests
{
    /// <summary>The JVM of the test process.</summary>
    internal static class TestJvm
    {
        private const int StopLimitMs = 5000;

        // The JVM outlives each play, as in an editor. It must stop before the process ends, because its threads need the runtime's signal handlers.
        static TestJvm()
        {
            UnityEngine.Headless.Loop.IsEditor = true;
            AppDomain.CurrentDomain.ProcessExit += (sender, arguments) => Jvm.Stop(StopLimitMs);
        }

        internal static string Home => Variable("COLLEKTIVE_TEST_JAVA_HOME");

        internal static string HostJar => Variable("COLLEKTIVE_HOST_JAR");

        /// <summary>A new object with the settings of the tests' JVM.</summary>
        internal static JvmSettings Settings => new JvmSettings
        {
            placement = Placement, maximumHeapMb = 256, collector = JvmCollector.Serial, cdsArchive = false,
        };

        /// <summary>The placement of the JVM in this test run.</summary>
        internal static JvmPlacement Placement { get; } = (JvmPlacement)Enum.Parse(
            typeof(JvmPlacement), Environment.GetEnvironmentVariable("COLLEKTIVE_TEST_PLACEMENT") ?? nameof(JvmPlacement.InProcess));

        /// <summary>The inspector's text that explains when changed settings take effect.</summary>
        internal static string WhenChangesTakeEffect => Placement == JvmPlacement.OwnProcess ? "at the next Play" : "after a restart of the editor";

        internal static JvmLaunch Launch(JvmSettings settings) => settings.ToLaunch(Home, HostJar, "unused");

        internal static void Start() => Jvm.Start(Launch(Settings));

        /// <summary>Opens a session of the probe programs.</summary>
        internal static Session Open(string program) => Session.Open(
            new SessionSettings { Seed = 1, Program = program, Jars = new[] { Variable("COLLEKTIVE_PROBE_JAR") } }, new ProbeSchema());

        /// <summary>Runs one tick with one node.</summary>
        internal static void Tick(Session session)
        {
            var request = session.Request;
            if (session.Tick == 0) request.AddNode(1, "", null);
            request.Sensors.EnsureCapacity(1);
            request.Sensors.Clear(0);
            request.ClearDue();
            request.AddDue(1);
            session.Step(0.05, 10000);
        }

        internal static string Variable(string name) =>
            Environment.GetEnvironmentVariable(name) ?? throw new InvalidOperationException(name + " is not set: run ./collektive test");
    }
}
