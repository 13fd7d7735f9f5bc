namespace UnityEngine
{
    /// Draws nothing, because the headless player has no screen and does not call OnGUI.
    public class GUI
    {
        public static void Label(Rect position, string text) => Headless.Gui.Placed.Add((position, text));
    }
}
