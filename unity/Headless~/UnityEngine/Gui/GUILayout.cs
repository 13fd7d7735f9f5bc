using UnityEngine.Headless;

namespace UnityEngine
{
    public sealed class GUILayoutOption { }

    public class GUILayout
    {
        public static bool Button(string text, params GUILayoutOption[] options)
        {
            Gui.Draw("button", text);
            return Gui.Take(text, false);
        }

        public static bool Toggle(bool value, string text, GUIStyle style, params GUILayoutOption[] options)
        {
            Gui.Draw("toggle", text, value ? "on" : "off");
            return Gui.Take(text, value);
        }

        public static int Toolbar(int selected, string[] texts, params GUILayoutOption[] options)
        {
            Gui.Draw("toolbar", string.Join(" ", texts), texts[selected]);
            return Gui.Take("toolbar", selected);
        }

        public static Vector2 BeginScrollView(Vector2 scrollPosition, params GUILayoutOption[] options) => Gui.Take("scroll", scrollPosition);
        public static void EndScrollView() { }
        public static void Space(float pixels) { }
        public static GUILayoutOption Height(float height) => null;
    }
}
