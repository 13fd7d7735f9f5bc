using UnityEditor.Headless;

namespace UnityEditor
{
    public class EditorUtility
    {
        /// Whether the object is an asset.
        public static bool IsPersistent(UnityEngine.Object target) => PrefabFile.Loaded.Contains(target);
        public static void RevealInFinder(string path) => Project.Revealed = path;
        public static void DisplayProgressBar(string title, string info, float progress) { }
        public static void ClearProgressBar() { }
    }
}
