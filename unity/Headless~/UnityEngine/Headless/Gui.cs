using System;
using System.Collections.Generic;

namespace UnityEngine.Headless
{
    /// Records the controls of immediate-mode GUI, and simulates actions of a user, for tests.
    public static class Gui
    {
        static readonly List<string> Drawn = new List<string>();
        static readonly Dictionary<string, object> Actions = new Dictionary<string, object>();

        static bool isPassing;

        /// One line for each control: "KIND NAME: VALUE". Disabled controls are prefixed with "(disabled) ".
        public static IReadOnlyList<string> Lines => Drawn;

        /// Labels that were drawn at positions chosen by scripts, without the layout. Tests clear the list.
        public static List<(Rect Place, string Text)> Placed { get; } = new List<(Rect Place, string Text)>();

        public static int DisabledDepth { get; set; }

        /// Changes the control with the given name to `value` when it is drawn next. The value `true` presses a button.
        public static void Act(string name, object value) => Actions[name] = value;

        /// Clears the recorded lines and actions.
        public static void Clear() => Drawn.Clear();

        /// Draws like the editor, with a layout pass and a pass for `input`. The default input is a repaint, or the actions of `Act`. `between` runs
        /// between the two passes. Both passes must draw the same controls, unless a control has used the event.
        public static void Passes(Action draw, Action between = null, Event input = null)
        {
            var shown = Drawn.Count;
            isPassing = true;
            Event.current = new Event { type = EventType.Layout };
            try
            {
                draw();
                var controls = Drawn.GetRange(shown, Drawn.Count - shown).ConvertAll(KindAndName);
                Drawn.RemoveRange(shown, controls.Count);
                between?.Invoke();
                Event.current = input ?? new Event { type = Actions.Count > 0 ? EventType.MouseDown : EventType.Repaint };
                draw();
                if (Event.current.type == EventType.Used) return;
                var repainted = Drawn.GetRange(shown, Drawn.Count - shown).ConvertAll(KindAndName);
                for (var i = 0; i < Math.Max(controls.Count, repainted.Count); i++)
                {
                    if (i < controls.Count && i < repainted.Count && controls[i] == repainted[i]) continue;
                    throw new ArgumentException("The layout had the control '" + (i < controls.Count ? controls[i] : "none") + "', but the repaint had '"
                        + (i < repainted.Count ? repainted[i] : "none") + "'");
                }
            }
            finally
            {
                Event.current = new Event { type = EventType.Layout };
                isPassing = false;
            }
        }

        /// Returns a line without the control's value, which may change between layout and repaint.
        static string KindAndName(string line) => line.IndexOf(": ", StringComparison.Ordinal) is int end && end >= 0 ? line.Substring(0, end) : line;

        public static void Draw(string kind, string name, string value = null)
        {
            if (!isPassing) throw new InvalidOperationException("the control '" + kind + " " + name + "' is drawn outside an event: use Gui.Passes");
            Drawn.Add((DisabledDepth > 0 ? "(disabled) " : "") + kind + " " + name + (value == null ? "" : ": " + value));
        }

        public static T Take<T>(string name, T value)
        {
            if (DisabledDepth > 0 || Event.current.type == EventType.Layout || !Actions.TryGetValue(name, out var changed)) return value;
            Actions.Remove(name);
            Changed = true;
            Event.current.Use();
            return (T)changed;
        }

        public static bool Changed { get; set; }
    }
}
