using UnityEngine;

namespace UnityEditor
{
    public class Editor : ScriptableObject
    {
        public Object target { get; set; }
        public Object[] targets => serializedObject.targetObjects;
        public SerializedObject serializedObject { get; private set; }

        public static Editor CreateEditor(Object targetObject) => CreateEditor(new[] { targetObject });

        /// Creates the editor that has [CustomEditor] for the type of the targets, or the default editor.
        public static Editor CreateEditor(Object[] targetObjects)
        {
            var editor = new Editor();
            foreach (var type in Headless.Menus.EditorTypes())
            {
                var mark = (CustomEditor)System.Attribute.GetCustomAttribute(type, typeof(CustomEditor));
                if (mark != null && mark.inspectedType == targetObjects[0].GetType()) editor = (Editor)CreateInstance(type);
            }
            editor.target = targetObjects[0];
            editor.serializedObject = new SerializedObject(targetObjects);
            return editor;
        }

        /// Draws only fields for which the package has a drawer.
        public bool DrawDefaultInspector()
        {
            UnityEngine.Headless.Gui.Draw("default inspector", target.GetType().Name);
            serializedObject.Update();
            Draw("", target.GetType());
            return serializedObject.ApplyModifiedProperties();
        }

        void Draw(string prefix, System.Type type)
        {
            foreach (var field in Headless.SerializedFields.FieldsOf(type))
            {
                if (field.IsDefined(typeof(HideInInspector), false)) continue;
                var property = serializedObject.FindProperty(prefix + field.Name);
                var drawer = Headless.Menus.DrawerOf(field);
                if (drawer == null && Headless.SerializedFields.IsObject(property.Value)) Draw(prefix + field.Name + ".", field.FieldType);
                if (drawer == null) continue;
                var label = new GUIContent(field.Name);
                drawer.OnGUI(new Rect(0, 0, 400, drawer.GetPropertyHeight(property, label)), property, label);
            }
        }

        public void Repaint() { }
        public virtual void OnInspectorGUI() => DrawDefaultInspector();
        public virtual bool RequiresConstantRepaint() => false;
    }

    public abstract class GUIDrawer { }

    public abstract class PropertyDrawer : GUIDrawer
    {
        public PropertyAttribute attribute { get; internal set; }
        public virtual void OnGUI(Rect position, SerializedProperty property, GUIContent label) { }
        public virtual float GetPropertyHeight(SerializedProperty property, GUIContent label) => EditorGUI.GetPropertyHeight(property, label, true);
    }
}
