using System.Collections.Generic;
using System.IO;
using System.Text.RegularExpressions;

namespace UnityEditor.Headless
{
    /// The open project. Its folder is the working folder of the process, and its only package is in another folder.
    public static class Project
    {
        const string Package = "Packages/org.collektive.unity";

        /// The folder of the package in the clone.
        static string Root => Path.Combine(System.Environment.GetEnvironmentVariable("COLLEKTIVE_ROOT") ?? "", "unity");

        /// The folder in which Unity's package manager would store the package, relative to the project and outside `Packages`.
        public const string PackageCache = "Library/PackageCache/org.collektive.unity@1a2b3c";

        internal static string PhysicalPath(string path) =>
            path == Package || path.StartsWith(Package + "/") ? PackageCache + path.Substring(Package.Length) : path;

        public static int Refreshes { get; internal set; }
        public static List<string> Imported { get; } = new List<string>();
        public static string Revealed { get; set; }
        public static UnityEngine.Object Pinged { get; internal set; }
        public static List<string> Undoable { get; } = new List<string>();

        /// The items of the Progress window, in the order in which they started; the index is the id.
        public static List<(string Description, Progress.Status Status)> ProgressItems { get; } = new List<(string, Progress.Status)>();

        static readonly Stack<(UnityEngine.Event Cause, System.Action Back)> UndoSteps = new Stack<(UnityEngine.Event, System.Action)>();

        static readonly Dictionary<string, string> PackagePaths = new Dictionary<string, string>();

        /// Reverts the changes that the last event made to fields in inspectors and settings, like Edit > Undo.
        public static void PerformUndo()
        {
            var cause = UndoSteps.Peek().Cause;
            while (UndoSteps.Count > 0 && UndoSteps.Peek().Cause == cause) UndoSteps.Pop().Back();
            Undo.undoRedoPerformed?.Invoke();
        }

        internal static void RecordUndo(System.Action back) => UndoSteps.Push((UnityEngine.Event.current, back));

        /// A function that returns the user's answer to a dialog with the given message.
        public static System.Func<string, bool> Answer { get; set; }

        /// Whether the simulated user clicks Cancel in progress bars.
        public static bool CancelsWaiting { get; set; }

        /// Returns the asset path of the file with this GUID in the package or the project; empty if none has it.
        internal static string PathOf(string guid)
        {
            if (PackagePaths.Count == 0) AddPaths(Root, Package, PackagePaths);
            if (PackagePaths.TryGetValue(guid, out var path)) return path;
            var own = new Dictionary<string, string>();
            if (Directory.Exists("Assets")) AddPaths("Assets", "Assets", own);
            return own.TryGetValue(guid, out path) ? path : "";
        }

        static void AddPaths(string folder, string prefix, Dictionary<string, string> paths)
        {
            foreach (var meta in Directory.GetFiles(folder, "*.meta", SearchOption.AllDirectories))
                paths[GuidIn(meta)] = prefix + meta.Substring(folder.Length, meta.Length - folder.Length - ".meta".Length).Replace('\\', '/');
        }

        /// Returns the GUID of an asset, after creating a missing meta file; empty if the asset does not exist.
        internal static string GuidOf(string asset)
        {
            var meta = FileOf(asset) + ".meta";
            if (!File.Exists(FileOf(asset))) return "";
            if (!File.Exists(meta)) File.WriteAllText(meta, "fileFormatVersion: 2\nguid: " + System.Guid.NewGuid().ToString("N") + "\n");
            return GuidIn(meta);
        }

        internal static string FileOf(string asset) => asset.StartsWith(Package) ? Root + asset.Substring(Package.Length) : asset;

        static string GuidIn(string meta) => Regex.Match(File.ReadAllText(meta), "^guid: ([0-9a-f]+)$", RegexOptions.Multiline).Groups[1].Value;
    }
}
