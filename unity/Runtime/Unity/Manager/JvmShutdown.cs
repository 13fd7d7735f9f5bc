using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Stops the JVM when the process quits, before the managed runtime ends. This saves flight recordings, and ends the Java threads while the runtime's
    /// signal handlers still exist. Leaving play mode in the editor does not stop the JVM.
    /// </summary>
    internal static class JvmShutdown
    {
        private const int LimitMs = 5000;

        /// <summary>Whether a player stops the JVM when it quits. If false, the JVM keeps running for the next scene.</summary>
        internal static bool IsEnabled { get; set; } = true;

#if UNITY_EDITOR
        [UnityEditor.InitializeOnLoadMethod]
        private static void RegisterInEditor()
        {
            UnityEditor.EditorApplication.quitting -= Stop;
            UnityEditor.EditorApplication.quitting += Stop;
        }
#endif

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        private static void Register()
        {
            if (Application.isEditor || !IsEnabled) return;
            Application.quitting -= Stop;
            Application.quitting += Stop;
        }

        private static void Stop()
        {
            try
            {
                Jvm.Stop(LimitMs);
            }
            catch (BridgeException error)
            {
                Debug.LogError("the JVM did not shut down cleanly: " + error.Message);
            }
            for (var log = new HostLog(); log.TryRead(out var level, out var line);)
            {
                if (level >= HostLogLevel.Warning) Debug.LogWarning(line);
            }
        }
    }
}
