using System.Collections.Generic;
using Collektive.Bridge;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>A node's inspector: its fields, the programs to choose from, and the parameters of its program.</summary>
    [CustomEditor(typeof(Node))]
    [CanEditMultipleObjects]
    internal sealed class NodeEditor : UnityEditor.Editor
    {
        /// <inheritdoc/>
        public override void OnInspectorGUI()
        {
            DrawDefaultInspector();
            var manager = FindAnyObjectByType<SimulationManager>();
            var index = manager != null ? ProgramIndex.Of(manager.Settings) : null;
            if (index == null) return;
            serializedObject.Update();
            var program = serializedObject.FindProperty("program");
            if (!program.hasMultipleDifferentValues) ProgramPicker.Draw(program, index, "(the manager's)");
            var used = index.Find(program.stringValue.Length > 0 ? program.stringValue : manager.Settings.program);
            if (targets.Length == 1 && used != null) DrawParameters(serializedObject.FindProperty("parameters"), used);
            serializedObject.ApplyModifiedProperties();
        }

        private static void DrawParameters(SerializedProperty values, ProgramInfo program)
        {
            if (program.Parameters.Count > 0) EditorGUILayout.LabelField("Parameters of " + program.Name);
            var declared = new List<string>();
            foreach (var parameter in program.Parameters)
            {
                declared.Add(parameter.Name);
                var place = PlaceOf(values, parameter.Name);
                var value = place < 0 ? parameter.DefaultValue : ValueAt(values, place).stringValue;
                var content = new GUIContent(parameter.Name, parameter.Description + " Default: " + parameter.DefaultValue);
                var edited = EditorGUILayout.TextField(content, value);
                if (edited != value) Set(values, place, parameter, edited);
            }
            for (var i = 0; i < values.arraySize; i++)
            {
                var name = NameAt(values, i).stringValue;
                if (!declared.Contains(name))
                    EditorGUILayout.HelpBox("Program '" + program.Name + "' has no parameter '" + name + "'. Its parameters: "
                        + (declared.Count > 0 ? string.Join(", ", declared) : "none"), MessageType.Error);
            }
        }

        /// <summary>Stores a value, or removes it if it equals the default.</summary>
        private static void Set(SerializedProperty values, int place, ProgramParameter parameter, string value)
        {
            if (value == parameter.DefaultValue)
            {
                if (place >= 0) values.DeleteArrayElementAtIndex(place);
                return;
            }
            if (place < 0)
            {
                place = values.arraySize;
                values.InsertArrayElementAtIndex(place);
                NameAt(values, place).stringValue = parameter.Name;
            }
            ValueAt(values, place).stringValue = value;
        }

        private static int PlaceOf(SerializedProperty values, string name)
        {
            for (var i = 0; i < values.arraySize; i++)
            {
                if (NameAt(values, i).stringValue == name) return i;
            }
            return -1;
        }

        private static SerializedProperty NameAt(SerializedProperty values, int place) => values.GetArrayElementAtIndex(place).FindPropertyRelative("name");

        private static SerializedProperty ValueAt(SerializedProperty values, int place) => values.GetArrayElementAtIndex(place).FindPropertyRelative("value");
    }
}
