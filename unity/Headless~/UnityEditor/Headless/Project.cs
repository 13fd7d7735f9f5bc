using System.Collections.Generic;
using System.IO;
using System.Text.RegularExpressions;

namespace UnityEditor.Headless
{
    /// The project that the editor has open: the process's working folder, with one package that lies elsewhere.
    public static class Project
    {
        const string Package = "Packages/org.collektive.unity";

        /// The package's folder: the clone's.
        static string Root => Path.Combine(System.Environment.GetEnvironmentVariable("COLLEKTIVE_ROOT") ?? "", "unity");

        /// Where the package manager keeps the package, below the working folder; it is not in `Packages`.
        public const string PackageCache = "Library/PackageCache/org.collektive.unity@1a2b3c";

        internal static string PhysicalPath(string path) =>
            path == Package || path.StartsWith(Package + "/") ? PackageCache + path.Substring(Package.Length) : path;

        public static int Refreshes { get; internal set; }
        public static List<string> Imported { get; } = new List<string>();
        public static string Revealed { get; set; }
        public static UnityEngine.Object Pinged { get; internal set; }
        public static List<string> Undoable { get; } = new List<string>();

        /// The items of the Progress window, in the order of their starts; the index is the id.
        public static List<(string Description, Progress.Status Status)> ProgressItems { get; } = new List<(string, Progress.Status)>();

        internal static Stack<System.Action> UndoSteps { get; } = new Stack<System.Action>();

        /// Takes back the last change of fields in inspectors and settings, as Edit > Undo does.
        public static void PerformUndo()
        {
            UndoSteps.Pop()();
            Undo.undoRedoPerformed?.Invoke();
        }

        /// The user's answer to a dialog, by its message.
        public static System.Func<string, bool> Answer { get; set; }

        /// Whether the user clicks Cancel beside a progress bar.
        public static bool CancelsWaiting { get; set; }

        /// The asset path of the package's file that has this GUID; empty if none has it.
        internal static string PathOf(string guid)
        {
            foreach (var meta in Directory.GetFiles(Root, "*.meta", SearchOption.AllDirectories))
            {
                if (Regex.IsMatch(File.ReadAllText(meta), "^guid: " + guid + "$", RegexOptions.Multiline))
                    return Package + meta.Substring(Root.Length, meta.Length - Root.Length - ".meta".Length);
            }
            return "";
        }

        internal static string FileOf(string asset) => asset.StartsWith(Package) ? Root + asset.Substring(Package.Length) : asset;
    }
}
