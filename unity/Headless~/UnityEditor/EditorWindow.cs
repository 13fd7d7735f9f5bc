using System;
using System.Collections.Generic;
using UnityEngine;
using UnityEngine.UIElements;

namespace UnityEditor
{
    public class EditorWindow : ScriptableObject
    {
        static readonly Dictionary<Type, EditorWindow> Windows = new Dictionary<Type, EditorWindow>();

        public GUIContent titleContent { get; set; }
        public VisualElement rootVisualElement { get; } = new VisualElement();
        internal bool HasGui { get; set; }
        public Rect position { get; set; } = new Rect(0f, 0f, 400f, 600f);

        public static T GetWindow<T>(string title) where T : EditorWindow
        {
            if (!Windows.TryGetValue(typeof(T), out var window)) Windows[typeof(T)] = window = CreateInstance<T>();
            window.titleContent = new GUIContent(title);
            return (T)window;
        }

        public void Close()
        {
            Windows.Remove(GetType());
            Headless.Menus.Send(this, "OnDisable");
        }

        public void Repaint() { }
    }
}
