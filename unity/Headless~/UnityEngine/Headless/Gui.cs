using System.Collections.Generic;

namespace UnityEngine.Headless
{
    /// What scripts drew with immediate-mode GUI, and what a user does to it: for tests.
    public static class Gui
    {
        static readonly List<string> Drawn = new List<string>();
        static readonly Dictionary<string, object> Actions = new Dictionary<string, object>();

        /// One line for each control: "KIND NAME: VALUE", controls that are disabled with "(disabled) " in front.
        public static IReadOnlyList<string> Lines => Drawn;

        public static int DisabledDepth { get; set; }

        /// The next time a control of that name is drawn, the user changes it to `value`; `true` presses a button.
        public static void Act(string name, object value) => Actions[name] = value;

        /// Forgets what was drawn.
        public static void Clear() => Drawn.Clear();

        public static void Draw(string kind, string name, string value = null) =>
            Drawn.Add((DisabledDepth > 0 ? "(disabled) " : "") + kind + " " + name + (value == null ? "" : ": " + value));

        public static T Take<T>(string name, T value)
        {
            if (DisabledDepth > 0 || !Actions.TryGetValue(name, out var changed)) return value;
            Actions.Remove(name);
            Changed = true;
            return (T)changed;
        }

        public static bool Changed { get; set; }
    }
}
