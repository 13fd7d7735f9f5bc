namespace UnityEngine
{
    /// The headless player has no screen: nothing is drawn, and it calls no OnGUI.
    public class GUI
    {
        public static void Label(Rect position, string text) { }
    }
}
