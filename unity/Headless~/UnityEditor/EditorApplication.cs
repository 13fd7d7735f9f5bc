using System;

namespace UnityEditor
{
    public enum PlayModeStateChange
    {
        EnteredEditMode,
        ExitingEditMode,
        EnteredPlayMode,
        ExitingPlayMode,
    }

    public sealed class EditorApplication
    {
        public static event Action<PlayModeStateChange> playModeStateChanged;

        static readonly System.Diagnostics.Stopwatch Clock = System.Diagnostics.Stopwatch.StartNew();

        public static bool isPlaying { get; set; }
        public static double timeSinceStartup => Clock.Elapsed.TotalSeconds;

        /// Calls the entry with that path, without a context. False if it does not exist.
        public static bool ExecuteMenuItem(string menuItemPath) => Headless.Menus.Click(menuItemPath);

        internal static void RaisePlayMode(PlayModeStateChange change)
        {
            if (change == PlayModeStateChange.EnteredPlayMode) isPlaying = true;
            if (change == PlayModeStateChange.ExitingPlayMode) isPlaying = false;
            playModeStateChanged?.Invoke(change);
        }
    }
}
