namespace UnityEngine
{
    public enum EventType
    {
        MouseDown = 0,
        Repaint = 7,
        Layout = 8,
        Used = 12,
    }

    /// What immediate-mode GUI is called for: each pass of events begins with a layout, which must draw the same controls.
    public sealed class Event
    {
        public static Event current { get; set; } = new Event { type = EventType.Layout };
        public EventType type { get; set; }
        public void Use() => type = EventType.Used;
    }
}
