using System;
using System.Collections.Generic;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public enum DragAndDropVisualMode
    {
        None = 0,
        Copy = 1,
        Link = 2,
    }

    public class DragAndDrop
    {
        public static Object[] objectReferences { get; set; } = new Object[0];
        public static DragAndDropVisualMode visualMode { get; set; }
        public static void AcceptDrag() => objectReferences = new Object[0];
    }

    public class GenericMenu
    {
        /// The last menu that was shown, for tests.
        internal static GenericMenu Shown { get; private set; }

        readonly Dictionary<string, MenuFunction> items = new Dictionary<string, MenuFunction>();

        internal IEnumerable<string> Items => items.Keys;

        public void AddItem(GUIContent content, bool on, MenuFunction func) => items.Add(content.text, func);
        public void ShowAsContext() => Shown = this;

        internal void Pick(string item) => items[item]();

        public delegate void MenuFunction();
    }
}
