using System;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// Draws a reference to a program. Unity would reject a dragged library, because it checks only the main object of a dragged file. The drawer therefore
    /// accepts dragged libraries itself, and offers their programs.
    /// </summary>
    [CustomPropertyDrawer(typeof(AggregateProgram))]
    internal sealed class AggregateProgramDrawer : PropertyDrawer
    {
        private const int BoxLines = 2;

        /// <inheritdoc/>
        public override float GetPropertyHeight(SerializedProperty property, GUIContent label) =>
            EditorGUIUtility.singleLineHeight * (IsNamed(NameOf(property)) ? 1 + BoxLines : 1);

        /// <inheritdoc/>
        public override void OnGUI(Rect position, SerializedProperty property, GUIContent label)
        {
            var line = new Rect(position.x, position.y, position.width, EditorGUIUtility.singleLineHeight);
            var name = NameOf(property);
            HandleDrop(line, property);
            EditorGUI.BeginChangeCheck();
            EditorGUI.ObjectField(line, property, label);
            if (EditorGUI.EndChangeCheck() && name != null) name.stringValue = "";
            if (!IsNamed(name)) return;
            EditorGUI.HelpBox(new Rect(line.x, line.yMax, line.width, BoxLines * line.height),
                "Program '" + name.stringValue + "' was set by name, by a script or an earlier version of the package. Select a program to replace it.",
                MessageType.Warning);
        }

        private static bool IsNamed(SerializedProperty name) => name != null && name.stringValue.Length > 0;

        /// <summary>
        /// Returns the field beside the reference that contains the program's name and takes precedence. Returns null for fields of users' scripts.
        /// </summary>
        private static SerializedProperty NameOf(SerializedProperty property)
        {
            var owner = property.serializedObject.targetObject;
            if (!(owner is Node) && !(owner is SimulationManager)) return null;
            var path = property.propertyPath;
            return property.serializedObject.FindProperty(path.Substring(0, path.LastIndexOf('.') + 1) + nameof(SimulationSettings.program));
        }

        private static void HandleDrop(Rect line, SerializedProperty property)
        {
            var now = Event.current;
            var isDrop = now.type == EventType.DragPerform;
            if (!isDrop && now.type != EventType.DragUpdated || !line.Contains(now.mousePosition)) return;
            var library = Array.Find(DragAndDrop.objectReferences, dragged => dragged is ProgramLibrary) as ProgramLibrary;
            if (library == null || library.Programs.Count == 0) return;
            DragAndDrop.visualMode = DragAndDropVisualMode.Link;
            now.Use();
            if (!isDrop) return;
            DragAndDrop.AcceptDrag();
            if (library.Programs.Count == 1) Set(property, library.Programs[0]);
            else ShowMenu(property.Copy(), library);
        }

        private static void ShowMenu(SerializedProperty property, ProgramLibrary library)
        {
            var menu = new GenericMenu();
            foreach (var program in library.Programs) menu.AddItem(new GUIContent(program.Name), false, () => Set(property, program));
            menu.ShowAsContext();
        }

        private static void Set(SerializedProperty property, AggregateProgram program)
        {
            property.serializedObject.Update();
            property.objectReferenceValue = program;
            var name = NameOf(property);
            if (name != null) name.stringValue = "";
            property.serializedObject.ApplyModifiedProperties();
        }
    }
}
