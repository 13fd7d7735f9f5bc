using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>Opens the session of a simulation.</summary>
    internal static class SessionStart
    {
        private const int StopLimitMs = 5000;

        /// <summary>Checks the settings, starts the JVM if none runs, and begins to open a session on it.</summary>
        /// <param name="context">The object that a click on a message selects.</param>
        /// <exception cref="BridgeException">The settings are wrong, or the JVM or the session did not start.</exception>
        internal static Session Begin(SimulationSettings settings, Object context)
        {
            var problem = Jvm.FindProblem() ?? settings.FindProblem() ?? settings.FindLibraryProblem();
            if (problem != null) throw new BridgeException(BridgeError.Argument, problem);
            var schema = Schemas.Find(settings.SchemaName);
            StartJvm(settings.jvm == null ? new JvmSettings() : settings.jvm.settings, context);
            return Session.BeginOpen(settings.ToSession(), schema);
        }

        /// <summary>Stops a JVM in a separate process after its session, unless the settings keep the JVM running.</summary>
        /// <exception cref="BridgeException">The JVM did not end within the time limit and was killed.</exception>
        internal static void Close(SimulationSettings settings)
        {
            if (settings.jvm != null && !settings.jvm.settings.keepWarm && Jvm.Process != 0 && Jvm.State == JvmState.Running) Jvm.Stop(StopLimitMs);
        }

        private static void StartJvm(JvmSettings settings, Object context)
        {
            try
            {
                var launch = Installation.ToLaunch(settings);
                if (launch.Note.Length > 0) Debug.Log(launch.Note, context);
                Jvm.Start(launch);
            }
            catch (BridgeException error) when (error.Error == BridgeError.JvmRunning)
            {
                Debug.LogWarning(error.Message + " The running JVM is used; the new settings take effect " + Jvm.WhenChangesTakeEffect + ".", context);
            }
        }
    }
}
