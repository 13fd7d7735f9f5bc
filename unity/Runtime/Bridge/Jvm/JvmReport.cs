using System;
using System.Collections.Generic;

namespace Collektive.Bridge
{
    /// <summary>
    /// A check of JVM settings for inspectors: their errors, the values in effect, and whether a restart is needed. Each change of the settings needs a new
    /// report. Checking the options takes 50 to 200 ms.
    /// </summary>
    internal sealed class JvmReport
    {
        private readonly Dictionary<string, string> problems = new Dictionary<string, string>();
        private readonly JvmStatus status;

        /// <summary>The running JVM; null if none runs.</summary>
        internal JvmStatus Status => status;

        private JvmReport(JvmStatus status)
        {
            this.status = status;
        }

        /// <summary>Whether the JVM would start with these settings.</summary>
        internal bool IsValid => problems.Count == 0;

        /// <summary>A remark that concerns all settings; may be empty.</summary>
        internal string Notice { get; private set; } = "";

        /// <summary>Checks <paramref name="settings"/> without starting a JVM. Call it from the main thread.</summary>
        /// <param name="settings">The settings to check.</param>
        /// <param name="toLaunch">Returns the JVM's command line; throws <see cref="BridgeException"/> if no JVM is found.</param>
        internal static JvmReport Of(JvmSettings settings, Func<JvmSettings, JvmLaunch> toLaunch) => Of(settings, Jvm.TryGetStatus(), toLaunch);

        /// <summary>Checks the settings against a status that was read earlier. May be called from any thread.</summary>
        internal static JvmReport Of(JvmSettings settings, JvmStatus status, Func<JvmSettings, JvmLaunch> toLaunch)
        {
            var report = new JvmReport(status);
            if (Jvm.FindProblem() != null) report.Add(nameof(JvmSettings.location), Jvm.FindProblem());
            foreach (var problem in settings.FindProblems()) report.Add(problem.Key, problem.Message);
            if (report.IsValid) report.Try(settings, toLaunch);
            return report;
        }

        /// <summary>Returns the error of a setting with the fix, or an empty string if the setting is valid.</summary>
        internal string Problem(JvmSetting setting) => problems.TryGetValue(setting.Key, out var problem) ? problem : "";

        /// <summary>Returns the value in effect in the running JVM, or an empty string if no JVM is running.</summary>
        internal string Effective(JvmSetting setting) => status == null ? "" : setting.Effective(status);

        private void Try(JvmSettings settings, Func<JvmSettings, JvmLaunch> toLaunch)
        {
            try
            {
                var launch = toLaunch(settings);
                Jvm.Check(launch);
                Compare(launch);
            }
            catch (BridgeException error) when (error.Error == BridgeError.JvmNotFound)
            {
                Add(settings.location == JvmLocation.Folder ? nameof(JvmSettings.home) : nameof(JvmSettings.location), error.Message);
            }
            catch (BridgeException error)
            {
                Add(JvmSetting.FindByErrorMessage(error.Message, settings).Key, error.Message);
            }
        }

        private void Compare(JvmLaunch launch)
        {
            if (status == null)
            {
                if (Jvm.Process != 0) return;
                if (Jvm.State == JvmState.Lost) Notice = "The JVM has crashed or stopped responding. Restart the editor to start a new one.";
                else if (Jvm.State == JvmState.Stopped) Notice = "The JVM has exited. Restart the editor to start a new one.";
                return;
            }
            var isSeparate = status.Process != 0;
            if (launch.Home == status.Home && Same(launch.Options, status.Options) && isSeparate == (launch.Placement == JvmPlacement.OwnProcess)) return;
            Notice = "Changes take effect " + Jvm.WhenChangesTakeEffect + ". The running JVM has: " +
                (status.Options.Count == 0 ? "no options" : string.Join(" ", status.Options)) + " (" + status.Home + ").";
        }

        private static bool Same(IReadOnlyList<string> a, IReadOnlyList<string> b)
        {
            if (a.Count != b.Count) return false;
            for (var i = 0; i < a.Count; i++)
            {
                if (a[i] != b[i]) return false;
            }
            return true;
        }

        private void Add(string key, string message)
        {
            problems[key] = problems.TryGetValue(key, out var before) ? before + "\n" + message : message;
        }
    }
}
