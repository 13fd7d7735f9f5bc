using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// A player that was started with <c>-batchmode</c> for a run with an end, <see cref="SimulationSettings.stopAfter"/>: it plays one tick in each frame,
    /// as fast as the machine can, and the process ends with the run.
    /// </summary>
    internal static class BatchPlayer
    {
        internal static void Begin(SimulationSettings settings)
        {
            if (!IsBatchRun(settings)) return;
            Time.captureDeltaTime = settings.deltaTime;
            Time.maximumDeltaTime = Mathf.Max(Time.maximumDeltaTime, settings.deltaTime);
        }

        /// <param name="isGood">Whether the run reached its end without an error; the process ends with 0 then, else with 1.</param>
        internal static void End(SimulationSettings settings, bool isGood)
        {
            if (IsBatchRun(settings)) Application.Quit(isGood ? 0 : 1);
        }

        private static bool IsBatchRun(SimulationSettings settings) => settings.stopAfter > 0 && Application.isBatchMode && !Application.isEditor;
    }
}
