using UnityEngine;

namespace UnityEditor
{
    public class Editor : ScriptableObject
    {
        public Object target { get; set; }
        public Object[] targets => new[] { target };
        public SerializedObject serializedObject { get; private set; }

        /// The editor that has [CustomEditor] for the target's type.
        public static Editor CreateEditor(Object targetObject)
        {
            foreach (var type in Headless.Menus.EditorTypes())
            {
                var mark = (CustomEditor)System.Attribute.GetCustomAttribute(type, typeof(CustomEditor));
                if (mark == null || mark.inspectedType != targetObject.GetType()) continue;
                var editor = (Editor)CreateInstance(type);
                editor.target = targetObject;
                editor.serializedObject = new SerializedObject(targetObject);
                return editor;
            }
            return null;
        }

        public bool DrawDefaultInspector()
        {
            UnityEngine.Headless.Gui.Draw("default inspector", target.GetType().Name);
            return false;
        }

        public void Repaint() { }
        public virtual void OnInspectorGUI() => DrawDefaultInspector();
        public virtual bool RequiresConstantRepaint() => false;
    }

    public abstract class GUIDrawer { }

    public abstract class PropertyDrawer : GUIDrawer
    {
        public virtual void OnGUI(Rect position, SerializedProperty property, GUIContent label) { }
        public virtual float GetPropertyHeight(SerializedProperty property, GUIContent label) => EditorGUI.GetPropertyHeight(property, label, true);
    }
}
