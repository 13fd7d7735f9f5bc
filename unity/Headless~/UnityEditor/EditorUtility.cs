using UnityEditor.Headless;

namespace UnityEditor
{
    public class EditorUtility
    {
        public static void RevealInFinder(string path) => Project.Revealed = path;
        public static void DisplayProgressBar(string title, string info, float progress) { }
        public static void ClearProgressBar() { }
    }
}
