namespace UnityEngine
{
    /// The headless player has no screen: it draws nothing, and does not call OnGUI.
    public class GUI
    {
        public static void Label(Rect position, string text) => Headless.Gui.Placed.Add((position, text));
    }
}
