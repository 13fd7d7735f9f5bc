using System.Reflection;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public class SerializedObject
    {
        public SerializedObject(Object obj) => targetObject = obj;
        public Object targetObject { get; }
        public SerializedProperty FindProperty(string propertyPath) => SerializedProperty.Of(targetObject, propertyPath);
        public void Update() { }
        public bool ApplyModifiedProperties() => true;
    }

    /// A field of an object; what is written to it arrives at once.
    public class SerializedProperty
    {
        readonly object owner;
        readonly FieldInfo field;

        SerializedProperty(object owner, FieldInfo field)
        {
            this.owner = owner;
            this.field = field;
        }

        public string name => field.Name;

        public string stringValue
        {
            get => (string)field.GetValue(owner);
            set => field.SetValue(owner, value);
        }

        public SerializedProperty FindPropertyRelative(string relativePropertyPath) => Of(field.GetValue(owner), relativePropertyPath);

        internal object Value
        {
            get => field.GetValue(owner);
            set => field.SetValue(owner, value);
        }

        internal static SerializedProperty Of(object owner, string name)
        {
            for (var type = owner.GetType(); type != null; type = type.BaseType)
            {
                var field = type.GetField(name, BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly);
                if (field != null) return new SerializedProperty(owner, field);
            }
            return null;
        }
    }
}
