using System;
using System.Collections;
using System.Reflection;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    public class SerializedObject
    {
        Action undo;

        public SerializedObject(Object obj) => targetObject = obj;
        public Object targetObject { get; }
        public SerializedProperty FindProperty(string propertyPath) => SerializedProperty.Of(() => targetObject, _ => { }, propertyPath, step => undo += step);
        public void Update() { }

        /// Whether any changed; then Undo takes all of them back.
        public bool ApplyModifiedProperties()
        {
            if (undo == null) return false;
            Headless.Project.UndoSteps.Push(undo);
            undo = null;
            return true;
        }
    }

    /// A field of an object or an element of a list; what is written to it arrives at once.
    public class SerializedProperty
    {
        readonly Func<object> get;
        readonly Action<object> set;
        readonly Action<Action> toUndo;

        SerializedProperty(string name, Func<object> get, Action<object> set, Action<Action> toUndo)
        {
            this.toUndo = toUndo;
            this.name = name;
            this.get = get;
            this.set = set;
        }

        public string name { get; }
        public bool hasMultipleDifferentValues => false;
        public int arraySize => List.Count;

        public string stringValue
        {
            get => (string)Value ?? "";
            set => Value = value;
        }

        internal object Value
        {
            get => get();
            set
            {
                var before = get();
                if (Equals(before, value)) return;
                set(value);
                toUndo(() => set(before));
            }
        }

        IList List => (IList)get();

        public SerializedProperty FindPropertyRelative(string relativePropertyPath) => Of(get, set, relativePropertyPath, toUndo);
        public SerializedProperty GetArrayElementAtIndex(int index) =>
            new SerializedProperty("data", () => List[index], value => List[index] = value, toUndo);

        /// The new element is a copy of the one before it.
        public void InsertArrayElementAtIndex(int index) =>
            List.Insert(index, List.Count > 0 ? List[Math.Max(0, index - 1)] : Activator.CreateInstance(List.GetType().GetGenericArguments()[0]));

        public void DeleteArrayElementAtIndex(int index) => List.RemoveAt(index);

        /// A field of what `owner` gives; `changed` gets the owner after a change, which must be stored again if it is a struct.
        internal static SerializedProperty Of(Func<object> owner, Action<object> changed, string name, Action<Action> toUndo)
        {
            for (var type = owner().GetType(); type != null; type = type.BaseType)
            {
                var field = type.GetField(name, BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly);
                if (field == null) continue;
                return new SerializedProperty(name, () => field.GetValue(owner()), value =>
                {
                    var it = owner();
                    field.SetValue(it, value);
                    changed(it);
                }, toUndo);
            }
            return null;
        }
    }
}
