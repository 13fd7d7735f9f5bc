using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Draws fields marked with <see cref="InspectorReadOnlyAttribute"/> as usual, but disabled.</summary>
    [CustomPropertyDrawer(typeof(InspectorReadOnlyAttribute))]
    internal sealed class ReadOnlyDrawer : PropertyDrawer
    {
        /// <inheritdoc/>
        public override float GetPropertyHeight(SerializedProperty property, GUIContent label) => EditorGUI.GetPropertyHeight(property, label, true);

        /// <inheritdoc/>
        public override void OnGUI(Rect position, SerializedProperty property, GUIContent label)
        {
            using (new EditorGUI.DisabledScope(true)) EditorGUI.PropertyField(position, property, label, true);
        }
    }
}
