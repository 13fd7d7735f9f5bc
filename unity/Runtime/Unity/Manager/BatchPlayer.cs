using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Support for players that are started with <c>-batchmode</c> and a duration, <see cref="SimulationSettings.stopAfter"/>. Such a player runs one tick
    /// per frame as fast as it can, and quits at the end of the run.
    /// </summary>
    internal static class BatchPlayer
    {
        internal static void Begin(SimulationSettings settings)
        {
            if (!IsBatchRun(settings)) return;
            Time.captureDeltaTime = settings.deltaTime;
            Time.maximumDeltaTime = Mathf.Max(Time.maximumDeltaTime, settings.deltaTime);
        }

        /// <param name="isGood">Whether the run reached its end without an error. The exit code is then 0, otherwise 1.</param>
        internal static void End(SimulationSettings settings, bool isGood)
        {
            if (IsBatchRun(settings)) Application.Quit(isGood ? 0 : 1);
        }

        private static bool IsBatchRun(SimulationSettings settings) => settings.stopAfter > 0 && Application.isBatchMode && !Application.isEditor;
    }
}
