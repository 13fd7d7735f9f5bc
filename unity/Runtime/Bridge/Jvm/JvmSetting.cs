using System;
using System.Collections.Generic;
using System.Globalization;
using System.Reflection;

namespace Collektive.Bridge
{
    /// <summary>Describes one field of <see cref="JvmSettings"/> for inspectors, scenario files and error messages.</summary>
    internal sealed class JvmSetting
    {
        private readonly FieldInfo field;
        private readonly Func<JvmStatus, string> effective;

        private JvmSetting(
            string key, string label, string tooltip, Func<JvmStatus, string> effective, string unit = "", int minimum = 0, int maximum = 0,
            int otherwise = 0, string marks = "")
        {
            field = typeof(JvmSettings).GetField(key);
            this.effective = effective;
            Key = key;
            Label = label;
            Tooltip = tooltip;
            Unit = unit;
            Minimum = minimum;
            Maximum = maximum;
            Otherwise = otherwise;
            Marks = marks.Split(new[] { ' ' }, StringSplitOptions.RemoveEmptyEntries);
        }

        /// <summary>All settings, in the order in which inspectors show them.</summary>
        internal static IReadOnlyList<JvmSetting> All { get; } = new[]
        {
            new JvmSetting(
                nameof(JvmSettings.location), "Location",
                "Location of the JVM. Automatic: the JVM package, or JAVA_HOME.", status => status.Home),
            new JvmSetting(
                nameof(JvmSettings.home), "Folder",
                "Root folder of a JRE or JDK 17 or newer, for the location Folder.", status => status.Home),
            new JvmSetting(
                nameof(JvmSettings.placement), "Placement",
                "In Process: on a thread of the editor. Own Process: in a child process. A crash of the JVM then ends only the session, and changed " +
                "settings take effect at the next Play.",
                status => status.Process == 0 ? nameof(JvmPlacement.InProcess) : "OwnProcess, process " + status.Process),
            new JvmSetting(
                nameof(JvmSettings.keepWarm), "Keep warm",
                "For Own Process: keep the JVM running between plays. Off: each Play starts a new JVM.", status => ""),
            new JvmSetting(
                nameof(JvmSettings.initialHeapMb), "Initial heap",
                "Initial heap size. Set it to the maximum heap size to avoid growth. 0: the JVM's default.",
                status => status.Megabytes("InitialHeapSize"), "MB", 8, 1 << 20, marks: "Xms Initial"),
            new JvmSetting(
                nameof(JvmSettings.maximumHeapMb), "Maximum heap",
                "Programs that need more memory fail with an OutOfMemoryError. 0: the JVM's default, a quarter of the machine's memory.",
                status => status.Megabytes("MaxHeapSize"), "MB", 16, 1 << 20, marks: "Xmx heap memory"),
            new JvmSetting(
                nameof(JvmSettings.collector), "Collector",
                "Garbage collector. Automatic selects Serial, the fastest if programs keep few objects. Choose Parallel, G1 or Z " +
                "for programs that keep many. " +
                "Not every JVM has Shenandoah.", EffectiveCollector, marks: "collector ollectors GC"),
            new JvmSetting(
                nameof(JvmSettings.compiler), "Compiler",
                "Tiered is the fastest in the long run. C1 warms up sooner. Interpreter is slow; use it to find bugs in compiled code.",
                EffectiveCompiler, marks: "TieredStopAtLevel Xint"),
            new JvmSetting(
                nameof(JvmSettings.compileThreshold), "Compile threshold",
                "Number of calls after which code is compiled, as a percentage of the JVM's default. Lower values compile sooner, with less profiling.",
                EffectiveThreshold, "%", 1, 10000, 100, "CompileThreshold"),
            new JvmSetting(
                nameof(JvmSettings.codeCacheMb), "Code cache",
                "Memory for compiled code. 0: the JVM's default.", status => status.Megabytes("ReservedCodeCacheSize"), "MB", 4, 2048,
                marks: "CodeCache"),
            new JvmSetting(
                nameof(JvmSettings.cdsArchive), "Class archive",
                "Save loaded classes to a file in the user's data when the JVM exits, for faster starts (JVM 19 or newer).",
                EffectiveArchive, marks: "Shared archive"),
            new JvmSetting(
                nameof(JvmSettings.assertions), "Assertions",
                "Check assert statements in programs.", status => status.Has("-ea") ? "on" : "off"),
            new JvmSetting(
                nameof(JvmSettings.debugPort), "Debug port",
                "TCP port for debuggers on this machine (JDWP). A debugger can run any code in this process. 0: off.",
                EffectivePort, "", 1024, 65535, marks: "jdwp transport JDWP"),
            new JvmSetting(
                nameof(JvmSettings.repeatableMaths), "Repeatable maths",
                "sin, exp, pow and other functions of Math give identical results on all JVMs and processors, but are slower.",
                status => status.Flag("UseLibmIntrinsic") == "false" ? "on" : "off", marks: "LibmIntrinsic"),
            new JvmSetting(
                nameof(JvmSettings.flags), "More flags",
                "JVM options, one per entry, for example -XX:MaxGCPauseMillis=5. They override the settings above.",
                status => string.Join(" ", status.Options)),
        };

        /// <summary>Name of the field and key in scenario files.</summary>
        internal string Key { get; }

        /// <summary>Label in inspectors.</summary>
        internal string Label { get; }

        /// <summary>Description for users.</summary>
        internal string Tooltip { get; }

        /// <summary>Unit of a number; may be empty.</summary>
        internal string Unit { get; }

        /// <summary>Minimum value. <see cref="Otherwise"/> may be lower.</summary>
        internal int Minimum { get; }

        /// <summary>Maximum value; 0 for settings that are not numeric.</summary>
        internal int Maximum { get; }

        /// <summary>The number that selects the JVM's default.</summary>
        internal int Otherwise { get; }

        /// <summary>Type of the field.</summary>
        internal Type Type => field.FieldType;

        private string[] Marks { get; }

        /// <summary>Returns the setting with the given key, or null.</summary>
        internal static JvmSetting Find(string key)
        {
            foreach (var setting in All)
            {
                if (setting.Key == key) return setting;
            }
            return null;
        }

        /// <summary>Returns the field's value.</summary>
        internal object Get(JvmSettings settings) => field.GetValue(settings);

        /// <summary>Sets the field to a value of <see cref="Type"/>.</summary>
        internal void Set(JvmSettings settings, object value) => field.SetValue(settings, value);

        /// <summary>Returns the value in effect in the running JVM.</summary>
        internal string Effective(JvmStatus status) => effective(status);

        /// <summary>Returns the error of this field, or null. Does not compare it with other fields.</summary>
        internal string FindProblem(JvmSettings settings)
        {
            var value = Get(settings);
            if (Type.IsEnum && !Enum.IsDefined(Type, value)) return "unknown " + Label.ToLowerInvariant() + " " + value + ": choose a value from the list";
            if (value == null) return Label.ToLowerInvariant() + " is not set";
            if (Maximum == 0) return null;
            var number = (int)value;
            if (number == Otherwise || (number >= Minimum && number <= Maximum)) return null;
            var off = Otherwise == 0 ? ", or 0" : "";
            return Label.ToLowerInvariant() + " is " + number.ToString(CultureInfo.InvariantCulture) + ": it must be " + Minimum + " to " + Maximum +
                (Unit.Length > 0 ? " " + Unit : "") + off;
        }

        /// <summary>Returns the setting that caused a JVM's error message, or the additional flags if no other setting matches.</summary>
        internal static JvmSetting FindByErrorMessage(string message, JvmSettings settings)
        {
            foreach (var flag in settings.flags)
            {
                if (!string.IsNullOrWhiteSpace(flag) && message.Contains(Core(flag))) return Find(nameof(JvmSettings.flags));
            }
            foreach (var setting in All)
            {
                foreach (var mark in setting.Marks)
                {
                    if (message.Contains(mark)) return setting;
                }
            }
            return Find(nameof(JvmSettings.flags));
        }

        /// <summary>Returns a flag in the form that JVMs quote in messages, without dashes, sign or value.</summary>
        private static string Core(string flag)
        {
            var core = flag.StartsWith("-XX:", StringComparison.Ordinal) ? flag.Substring(4).TrimStart('+', '-') : flag;
            var value = core.IndexOf('=');
            return value > 0 ? core.Substring(0, value) : core;
        }

        private static string EffectiveCollector(JvmStatus status)
        {
            foreach (JvmCollector collector in Enum.GetValues(typeof(JvmCollector)))
            {
                if (status.Flag(FlagOf(collector)) == "true") return collector.ToString();
            }
            return "another";
        }

        /// <summary>Returns whether a JVM flag selects the garbage collector.</summary>
        internal static bool IsCollector(string flag) =>
            flag != null && flag.StartsWith("-XX:+Use", StringComparison.Ordinal) && flag.EndsWith("GC", StringComparison.Ordinal);

        internal static string FlagOf(JvmCollector collector) => collector == JvmCollector.Z ? "UseZGC" : "Use" + collector + "GC";

        private static string EffectiveCompiler(JvmStatus status)
        {
            if (status.Has("-Xint")) return nameof(JvmCompiler.Interpreter);
            var level = status.Flag("TieredStopAtLevel");
            return level == "1" ? nameof(JvmCompiler.C1) : status.Flag("TieredCompilation") == "true" ? nameof(JvmCompiler.Tiered) : "C2 only";
        }

        private static string EffectiveThreshold(JvmStatus status)
        {
            var scaling = status.Flag("CompileThresholdScaling");
            return double.TryParse(scaling, NumberStyles.Float, CultureInfo.InvariantCulture, out var factor)
                ? Math.Round(factor * 100).ToString(CultureInfo.InvariantCulture) + " %"
                : "unknown";
        }

        private static string EffectiveArchive(JvmStatus status)
        {
            if (status.Flag("UseSharedSpaces") != "true") return "off";
            return status.Flag("AutoCreateSharedArchive") == "true" ? "on" : "the JVM's own";
        }

        private static string EffectivePort(JvmStatus status)
        {
            const string mark = "address=127.0.0.1:";
            foreach (var option in status.Options)
            {
                var at = option.IndexOf(mark, StringComparison.Ordinal);
                if (option.StartsWith("-agentlib:jdwp", StringComparison.Ordinal) && at > 0) return option.Substring(at + mark.Length);
            }
            return "off";
        }
    }
}
