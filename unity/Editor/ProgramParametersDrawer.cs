using System;
using System.Collections.Generic;
using System.Globalization;
using Collektive.Bridge;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Draws the parameters of the program that the selected nodes run. Each parameter has a field of its type.</summary>
    [CustomPropertyDrawer(typeof(ProgramParametersAttribute))]
    internal sealed class ProgramParametersDrawer : PropertyDrawer
    {
        private const int BoxLines = 2;

        private static float Line => EditorGUIUtility.singleLineHeight + EditorGUIUtility.standardVerticalSpacing;

        /// <inheritdoc/>
        public override float GetPropertyHeight(SerializedProperty property, GUIContent label)
        {
            var program = ProgramOf(property);
            if (program == null) return EditorGUI.GetPropertyHeight(property, label, true);
            return (1 + program.Parameters.Count + (1 + BoxLines) * UnknownIn(property, program).Count) * Line;
        }

        /// <inheritdoc/>
        public override void OnGUI(Rect position, SerializedProperty property, GUIContent label)
        {
            var program = ProgramOf(property);
            if (program == null)
            {
                EditorGUI.PropertyField(position, property, label, true);
                return;
            }
            var line = new Rect(position.x, position.y, position.width, EditorGUIUtility.singleLineHeight);
            EditorGUI.LabelField(line, "Parameters of " + program.Name);
            foreach (var parameter in program.Parameters) Draw(line = Below(line, 1), property, parameter);
            foreach (var name in UnknownIn(property, program))
            {
                Draw(line = Below(line, 1), property, new ProgramParameter(name, "", ""));
                line = Below(line, 1);
                EditorGUI.HelpBox(new Rect(line.x, line.y, line.width, BoxLines * EditorGUIUtility.singleLineHeight),
                    "Program '" + program.Name + "' has no parameter '" + name + "'. Clear the field to remove the value.", MessageType.Error);
                line = Below(line, BoxLines - 1);
            }
        }

        private static Rect Below(Rect line, int lines) => new Rect(line.x, line.y + lines * Line, line.width, line.height);

        /// <summary>Returns the program that all selected nodes run, or null if the nodes run different programs or an unknown program.</summary>
        private static AggregateProgram ProgramOf(SerializedProperty property)
        {
            var manager = UnityEngine.Object.FindAnyObjectByType<SimulationManager>();
            var settings = manager != null ? manager.Settings : new SimulationSettings();
            AggregateProgram common = null;
            foreach (var target in property.serializedObject.targetObjects)
            {
                var node = (Node)target;
                var program = node.OwnProgram != null ? node.OwnProgram : settings.FindProgram(settings.ProgramOf(node));
                if (program == null || common != null && program != common) return null;
                common = program;
            }
            return common;
        }

        /// <summary>Returns the names of values that the program does not declare.</summary>
        private static List<string> UnknownIn(SerializedProperty property, AggregateProgram program)
        {
            var unknown = new List<string>();
            foreach (var target in property.serializedObject.targetObjects)
            {
                foreach (var value in ((Node)target).Parameters)
                {
                    var isDeclared = false;
                    foreach (var parameter in program.Parameters) isDeclared |= parameter.Name == value.name;
                    if (!isDeclared && !unknown.Contains(value.name)) unknown.Add(value.name);
                }
            }
            return unknown;
        }

        private static void Draw(Rect line, SerializedProperty property, ProgramParameter parameter)
        {
            var targets = property.serializedObject.targetObjects;
            var value = ValueOf((Node)targets[0], parameter);
            EditorGUI.showMixedValue = Array.Exists(targets, target => ValueOf((Node)target, parameter) != value);
            EditorGUI.BeginChangeCheck();
            var edited = Edit(line, parameter, value);
            EditorGUI.showMixedValue = false;
            if (EditorGUI.EndChangeCheck()) Set(property, parameter, edited);
        }

        /// <summary>Draws a field of the parameter's type, or a text field if the value has another type.</summary>
        private static string Edit(Rect line, ProgramParameter parameter, string value)
        {
            var label = new GUIContent(parameter.Name, (parameter.Description + " Default: " + parameter.DefaultValue).Trim());
            var culture = CultureInfo.InvariantCulture;
            if (parameter.Type == ParameterType.Boolean && bool.TryParse(value, out var isOn)) return EditorGUI.Toggle(line, label, isOn) ? "true" : "false";
            if (parameter.Type == ParameterType.Integer && int.TryParse(value, NumberStyles.AllowLeadingSign, culture, out var integer))
                return EditorGUI.IntField(line, label, integer).ToString(culture);
            if (parameter.Type == ParameterType.Number && double.TryParse(value, NumberStyles.Float, culture, out var number))
                return EditorGUI.DoubleField(line, label, number).ToString("R", culture);
            var values = new List<string>(parameter.Values);
            var selected = values.IndexOf(value);
            if (selected < 0) return EditorGUI.TextField(line, label, value);
            return values[EditorGUI.Popup(line, label, selected, values.ConvertAll(each => new GUIContent(each)).ToArray())];
        }

        private static string ValueOf(Node node, ProgramParameter parameter)
        {
            var index = node.Parameters.FindIndex(value => value.name == parameter.Name);
            return index < 0 ? parameter.DefaultValue : node.Parameters[index].value;
        }

        /// <summary>
        /// Stores a value in each selected node, or removes the stored value if the new value is the default. Each node is edited separately, because the
        /// lists of the nodes differ.
        /// </summary>
        private static void Set(SerializedProperty property, ProgramParameter parameter, string value)
        {
            foreach (var target in property.serializedObject.targetObjects)
            {
                using (var node = new SerializedObject(target))
                {
                    Store(node.FindProperty(property.propertyPath), parameter, value);
                    node.ApplyModifiedProperties();
                }
            }
            property.serializedObject.Update();
        }

        private static void Store(SerializedProperty values, ProgramParameter parameter, string value)
        {
            var index = 0;
            while (index < values.arraySize && NameAt(values, index).stringValue != parameter.Name) index++;
            var isNew = index == values.arraySize;
            if (IsDefault(parameter, value))
            {
                if (!isNew) values.DeleteArrayElementAtIndex(index);
                return;
            }
            if (isNew)
            {
                values.InsertArrayElementAtIndex(index);
                NameAt(values, index).stringValue = parameter.Name;
            }
            values.GetArrayElementAtIndex(index).FindPropertyRelative(nameof(NodeParameter.value)).stringValue = value;
        }

        private static bool IsDefault(ProgramParameter parameter, string value)
        {
            var isNumber = parameter.Type == ParameterType.Integer || parameter.Type == ParameterType.Number;
            return value == parameter.DefaultValue || isNumber && double.TryParse(value, NumberStyles.Float, CultureInfo.InvariantCulture, out var number)
                && number == double.Parse(parameter.DefaultValue, NumberStyles.Float, CultureInfo.InvariantCulture);
        }

        private static SerializedProperty NameAt(SerializedProperty values, int index) =>
            values.GetArrayElementAtIndex(index).FindPropertyRelative(nameof(NodeParameter.name));
    }
}
