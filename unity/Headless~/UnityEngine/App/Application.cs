using System;
using System.IO;

namespace UnityEngine
{
    public class Application
    {
        public delegate void LogCallback(string condition, string stackTrace, LogType type);

        public static event LogCallback logMessageReceived;
        public static event LogCallback logMessageReceivedThreaded;
        public static event Func<bool> wantsToQuit;
        public static event Action quitting;

        static Application() => ResetState();

        /// The user's data folder, or the temporary folder if the user has none.
        private static string DataFolder
        {
            get
            {
                var folder = Environment.GetFolderPath(Environment.SpecialFolder.LocalApplicationData);
                return folder.Length > 0 ? folder : Path.GetTempPath();
            }
        }

        public static bool isPlaying => true;
        public static bool isEditor => Headless.Loop.IsEditor;
        public static bool isBatchMode => Headless.Loop.IsBatchMode;
        public static bool runInBackground { get; set; }
        public static int targetFrameRate { get; set; }
        public static string dataPath => Headless.Loop.DataPath;
        public static string streamingAssetsPath => Path.Combine(dataPath, "StreamingAssets");
        public static string persistentDataPath => Path.Combine(DataFolder, productName);
        public static string consoleLogPath => Path.Combine(persistentDataPath, "Player.log");
        public static string temporaryCachePath => Path.GetTempPath();
        public static string unityVersion => "6000.0.0f1";
        public static string version => "1.0";
        public static string productName => "collektive-headless";
        public static RuntimePlatform platform => RuntimePlatform.LinuxPlayer;

        /// Stores the address in `Headless.Loop.OpenedUrl`, and opens nothing.
        public static void OpenURL(string url) => Headless.Loop.OpenedUrl = url;

        public static void Quit() => Quit(0);

        /// Ends the player after the current frame, unless a `wantsToQuit` handler returns false.
        public static void Quit(int exitCode)
        {
            var allowed = true;
            foreach (var handler in wantsToQuit?.GetInvocationList() ?? Array.Empty<Delegate>())
            {
                Headless.Loop.InvokeAll(() => allowed = ((Func<bool>)handler)());
                if (!allowed) return;
            }
            Headless.Loop.RequestQuit(exitCode);
        }

        // Messages that a handler logs are not sent to handlers, because that would never end.
        [ThreadStatic] static bool isRaising;

        internal static void RaiseLog(string message, string stackTrace, LogType type)
        {
            if (isRaising) return;
            isRaising = true;
            try
            {
                if (Headless.Loop.IsMainThread) Headless.Loop.InvokeAll(() => logMessageReceived?.Invoke(message, stackTrace, type));
                Headless.Loop.InvokeAll(() => logMessageReceivedThreaded?.Invoke(message, stackTrace, type));
            }
            finally
            {
                isRaising = false;
            }
        }

        internal static void RaiseQuitting() => Headless.Loop.InvokeAll(quitting);

        internal static void ResetState()
        {
            logMessageReceived = logMessageReceivedThreaded = null;
            wantsToQuit = null;
            quitting = null;
            runInBackground = true;
            targetFrameRate = -1;
        }
    }

    public enum RuntimePlatform
    {
        OSXEditor = 0,
        OSXPlayer = 1,
        WindowsPlayer = 2,
        WindowsEditor = 7,
        LinuxPlayer = 13,
        LinuxEditor = 16,
        LinuxHeadlessSimulation = 35,
        EmbeddedLinuxArm64 = 39,
        EmbeddedLinuxX64 = 41,
        LinuxServer = 43,
        WindowsServer = 44,
        OSXServer = 45,
    }
}
