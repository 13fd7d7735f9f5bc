using UnityEditor.Headless;

namespace UnityEditor
{
    public class EditorUtility
    {
        /// Returns whether the object is an asset.
        public static bool IsPersistent(UnityEngine.Object target) => PrefabFile.Loaded.ContainsKey(target);
        public static void RevealInFinder(string path) => Project.Revealed = path;
        public static bool DisplayDialog(string title, string message, string ok, string cancel) => Project.Answer(message);
        public static void DisplayProgressBar(string title, string info, float progress) { }
        public static bool DisplayCancelableProgressBar(string title, string info, float progress) => Project.CancelsWaiting;
        public static void ClearProgressBar() { }
    }
}
