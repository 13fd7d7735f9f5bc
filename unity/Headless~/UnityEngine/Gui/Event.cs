namespace UnityEngine
{
    public enum EventType
    {
        MouseDown = 0,
        Repaint = 7,
        Layout = 8,
        DragUpdated = 9,
        DragPerform = 10,
        Used = 12,
    }

    /// The event of an immediate-mode GUI call. A layout event precedes each other event, and must draw the same controls.
    public sealed class Event
    {
        public static Event current { get; set; } = new Event { type = EventType.Layout };
        public EventType type { get; set; }
        public Vector2 mousePosition { get; set; }
        public void Use() => type = EventType.Used;
    }
}
