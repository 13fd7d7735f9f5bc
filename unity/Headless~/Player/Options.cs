using System;
using System.Collections.Generic;
using System.Globalization;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>The command line of the player. <c>./collektive run</c> and other commands start the player with it.</summary>
    internal sealed class Options
    {
        internal const string Usage =
            "Player plan SCENARIO [--seed K] [--seconds S] [--set KEY=VALUE]... [--folder DIR] [--trust-jvm]\n" +
            "Player run SCENARIO --scripts DLL --jar JAR [--jar JAR]... --host-jar JAR --java-home DIR --out DIR\n" +
            "           [--template HTML] [--recording JFR] [--seed K] [--seconds S] [--set KEY=VALUE]... [--folder DIR]\n" +
            "           [--inputs JSON] [--keep-going] [--trust-jvm] [--debug PORT] [--check]\n" +
            "Player live SCENARIO --scripts DLL --jar JAR --host-jar JAR --java-home DIR --out DIR --channel DESCRIPTOR [options of run]\n" +
            "Player serve SCENARIO --scripts DLL --jar JAR --host-jar JAR --java-home DIR --channel DESCRIPTOR [--inputs JSON] [--trust-jvm]\n" +
            "SCENARIO: a scenario file, or the manifest of a run to repeat";

        internal string Command { get; private set; }

        internal string Scenario { get; private set; }

        internal string Scripts { get; private set; }

        internal List<string> Jars { get; } = new List<string>();

        internal string HostJar { get; private set; }

        internal string JavaHome { get; private set; }

        internal string Out { get; private set; }

        /// <summary>Folder to which the paths in the scenario are relative; null for the default.</summary>
        internal string Folder { get; private set; }

        /// <summary>Whether the JVM settings in the scenario may write files, open ports and load code.</summary>
        internal bool TrustJvm { get; private set; }

        /// <summary>Hashes of the parts of the project, which are written to the manifest.</summary>
        internal JObject Inputs { get; private set; } = new JObject();

        /// <summary>Descriptor of the socket of <see cref="Server"/> or <see cref="LiveChannel"/>; -1 for other commands.</summary>
        internal int Channel { get; private set; } = -1;

        internal string Template { get; private set; }

        /// <summary>File of a flight recording of the whole run; null for none.</summary>
        internal string Recording { get; private set; }

        /// <summary>Port on which the run waits for a debugger; 0 for none.</summary>
        internal int DebugPort { get; private set; }

        internal ulong? Seed { get; private set; }

        internal double? Seconds { get; private set; }

        /// <summary>Whether the run continues after a tick in which all rounds failed.</summary>
        internal bool KeepGoing { get; private set; }

        /// <summary>Whether the run ends after its first tick, without a replay.</summary>
        internal bool IsCheck { get; private set; }

        /// <summary>Overrides of scenario keys on the command line.</summary>
        internal List<Assignment> Assignments { get; } = new List<Assignment>();

        /// <summary>Values of fields of the scene on the command line, in the form <c>FIELD=VALUE</c>.</summary>
        internal List<string> FieldAssignments { get; } = new List<string>();

        /// <summary>Returns a copy of these options with another output folder, for one of several runs.</summary>
        internal Options For(string folder)
        {
            var options = (Options)MemberwiseClone();
            options.Out = folder;
            return options;
        }

        internal static Options Parse(string[] arguments)
        {
            if (arguments.Length < 2 || Array.IndexOf(new[] { "plan", "run", "live", "serve" }, arguments[0]) < 0)
                throw new ScenarioException("usage:\n" + Usage);
            var options = new Options { Command = arguments[0], Scenario = arguments[1] };
            for (var i = 2; i < arguments.Length; i += 2)
            {
                if (options.SetFlag(arguments[i]))
                {
                    i--;
                    continue;
                }
                if (i + 1 == arguments.Length) throw new ScenarioException(arguments[i] + " needs a value");
                options.Set(arguments[i], arguments[i + 1]);
            }
            return options;
        }

        private void AddAssignment(Assignment assignment, string field)
        {
            if (assignment == null)
            {
                FieldAssignments.Add(field);
                return;
            }
            // Fields are set after all keys. An earlier assignment of a field that this key changes must become a key, so that it does not override this key.
            foreach (var earlier in FieldAssignments.FindAll(assignment.Changes))
            {
                Assignments.Add(Assignment.OfField(earlier));
                FieldAssignments.Remove(earlier);
            }
            Assignments.Add(assignment);
        }

        private bool SetFlag(string name)
        {
            switch (name)
            {
                case "--trust-jvm": return TrustJvm = true;
                case "--keep-going": return KeepGoing = true;
                case "--check": return IsCheck = true;
                default: return false;
            }
        }

        private void Set(string name, string value)
        {
            switch (name)
            {
                case "--scripts": Scripts = value; break;
                case "--jar": Jars.Add(value); break;
                case "--host-jar": HostJar = value; break;
                case "--java-home": JavaHome = value; break;
                case "--out": Out = value; break;
                case "--folder": Folder = value; break;
                case "--inputs": Inputs = JObject.Parse(value); break;
                case "--channel": Channel = int.Parse(value, CultureInfo.InvariantCulture); break;
                case "--template": Template = value; break;
                case "--recording": Recording = value; break;
                case "--set": AddAssignment(Assignment.Parse(value, out var field), field); break;
                case "--debug":
                    if (!int.TryParse(value, NumberStyles.None, CultureInfo.InvariantCulture, out var port) || port < 1024 || port > 65535)
                    {
                        throw new ScenarioException("--debug " + value + ": it must be a port from 1024 to 65535");
                    }
                    DebugPort = port;
                    break;
                case "--seed":
                    if (!ulong.TryParse(value, NumberStyles.None, CultureInfo.InvariantCulture, out var seed))
                    {
                        throw new ScenarioException("--seed " + value + ": it must be a whole number from 0 to 2^64 - 1");
                    }
                    Seed = seed;
                    break;
                case "--seconds":
                    if (!ExactNumber.TryParse(value, out var seconds) || !(seconds > 0))
                    {
                        throw new ScenarioException("--seconds " + value + ": it must be a number greater than 0");
                    }
                    Seconds = seconds;
                    break;
                default: throw new ScenarioException("unknown option " + name + "\nusage:\n" + Usage);
            }
        }
    }
}
