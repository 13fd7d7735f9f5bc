using System;
using UnityEngine;
using UnityEngine.Headless;

namespace UnityEditor
{
    public enum MessageType
    {
        None = 0,
        Info = 1,
        Warning = 2,
        Error = 3,
    }

    public sealed class EditorStyles
    {
        public static GUIStyle boldLabel { get; } = new GUIStyle();
        public static GUIStyle radioButton { get; } = new GUIStyle();
    }

    public sealed class EditorGUIUtility
    {
        public static float singleLineHeight => 18f;
        public static float standardVerticalSpacing => 2f;
        public static void PingObject(UnityEngine.Object obj) => Headless.Project.Pinged = obj;
    }

    public sealed class EditorGUI
    {
        public static int indentLevel { get; set; }
        public static bool showMixedValue { get; set; }
        public static void BeginChangeCheck() => Gui.Changed = false;
        public static bool EndChangeCheck() => Gui.Changed;
        public static float GetPropertyHeight(SerializedProperty property, GUIContent label, bool includeChildren) => EditorGUIUtility.singleLineHeight;

        public static void HelpBox(Rect position, string message, MessageType type) => Gui.Draw("help", type.ToString(), message);
        public static void LabelField(Rect position, string label) => Gui.Draw("label", label);
        public static int IntField(Rect position, GUIContent label, int value) => Draw("int", label, value);
        public static double DoubleField(Rect position, GUIContent label, double value) => Draw("double", label, value);
        public static bool Toggle(Rect position, GUIContent label, bool value) => Draw("toggle", label, value);
        public static string TextField(Rect position, GUIContent label, string text) => Draw("text", label, text);

        public static int Popup(Rect position, GUIContent label, int selectedIndex, GUIContent[] displayedOptions)
        {
            Gui.Draw("popup", label.text, showMixedValue ? "(mixed)" : displayedOptions[selectedIndex].text);
            return Gui.Take(label.text, selectedIndex);
        }

        public static void ObjectField(Rect position, SerializedProperty property, GUIContent label)
        {
            showMixedValue = property.hasMultipleDifferentValues;
            var old = property.objectReferenceValue;
            var value = Draw("object", label, old);
            showMixedValue = false;
            if (!ReferenceEquals(value, old)) property.objectReferenceValue = value;
        }

        static T Draw<T>(string kind, GUIContent label, T value)
        {
            var text = value is UnityEngine.Object reference ? reference.name : Convert.ToString(value, System.Globalization.CultureInfo.InvariantCulture);
            Gui.Draw(kind, label.text, showMixedValue ? "(mixed)" : text);
            return Gui.Take(label.text, value);
        }

        public static bool PropertyField(Rect position, SerializedProperty property, GUIContent label, bool includeChildren)
        {
            Gui.Draw("property", property.name);
            return false;
        }

        public struct DisabledScope : IDisposable
        {
            readonly bool disabled;

            public DisabledScope(bool disabled)
            {
                this.disabled = disabled;
                if (disabled) Gui.DisabledDepth++;
            }

            public void Dispose()
            {
                if (disabled) Gui.DisabledDepth--;
            }
        }
    }

    public sealed class EditorGUILayout
    {
        public static void LabelField(string label, params GUILayoutOption[] options) => Gui.Draw("label", label);
        public static void LabelField(string label, GUIStyle style, params GUILayoutOption[] options) => Gui.Draw("label", label);
        public static void LabelField(string label, string label2, params GUILayoutOption[] options) => Gui.Draw("label", label, label2);
        public static void HelpBox(string message, MessageType type) => Gui.Draw("help", type.ToString(), message);
        public static void Space() { }
        public static Rect BeginHorizontal(params GUILayoutOption[] options) => default;
        public static void EndHorizontal() { }

        public static bool PropertyField(SerializedProperty property, GUIContent label, bool includeChildren, params GUILayoutOption[] options)
        {
            Gui.Draw("property", label.text, property.Value?.ToString() ?? "");
            property.Value = Gui.Take(label.text, property.Value);
            return false;
        }

        public static void DelayedTextField(SerializedProperty property, GUIContent label, params GUILayoutOption[] options) =>
            PropertyField(property, label, false);

        public static void DelayedIntField(SerializedProperty property, GUIContent label, params GUILayoutOption[] options) =>
            PropertyField(property, label, false);

        public static string TextField(string label, string text, params GUILayoutOption[] options)
        {
            Gui.Draw("text", label, text);
            return Gui.Take(label, text);
        }

        public static string TextField(GUIContent label, string text, params GUILayoutOption[] options) => TextField(label.text, text);

        public static int Popup(string label, int selectedIndex, string[] displayedOptions, params GUILayoutOption[] options)
        {
            Gui.Draw("popup", label, string.Join(" | ", displayedOptions) + ": " + displayedOptions[selectedIndex]);
            return Gui.Take(label, selectedIndex);
        }

        public static bool Toggle(GUIContent label, bool value, params GUILayoutOption[] options)
        {
            Gui.Draw("toggle", label.text, value ? "on" : "off");
            return Gui.Take(label.text, value);
        }

        public static bool Foldout(bool foldout, string content, bool toggleOnLabelClick)
        {
            Gui.Draw("foldout", content, foldout ? "open" : "closed");
            return Gui.Take(content, foldout);
        }
    }
}
