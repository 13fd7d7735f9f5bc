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
        public delegate void CallbackFunction();

        public static CallbackFunction update;
        public static CallbackFunction delayCall;

        public static event Action<PlayModeStateChange> playModeStateChanged;

        static readonly System.Diagnostics.Stopwatch Clock = System.Diagnostics.Stopwatch.StartNew();

        public static bool isPlaying { get; set; }
        public static bool isCompiling { get; internal set; }
        public static double timeSinceStartup => Clock.Elapsed.TotalSeconds;

        /// Executes the menu entry with the given path, without a context. Returns false if the entry does not exist.
        public static bool ExecuteMenuItem(string menuItemPath) => Headless.Menus.Click(menuItemPath);

        /// Runs one iteration of the editor's loop. Calls added during an iteration run in the next one.
        internal static void Tick()
        {
            var delayed = delayCall;
            delayCall = null;
            delayed?.Invoke();
            update?.Invoke();
        }

        internal static void RaisePlayMode(PlayModeStateChange change)
        {
            if (change == PlayModeStateChange.EnteredPlayMode) isPlaying = true;
            if (change == PlayModeStateChange.ExitingPlayMode) isPlaying = false;
            playModeStateChanged?.Invoke(change);
        }
    }
}
