using System;
using System.Collections;
using System.Collections.Generic;
using System.Text.RegularExpressions;
using UnityEditor.Headless;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    /// A copy of the serialised fields of one or more objects. `ApplyModifiedProperties` writes changes back to the objects; they can be undone.
    public class SerializedObject : IDisposable
    {
        internal readonly SerializedFields[] Copies;

        public SerializedObject(Object obj) : this(new[] { obj }) { }

        public SerializedObject(Object[] objs)
        {
            targetObjects = objs;
            Copies = Array.ConvertAll(objs, each => new SerializedFields(each));
        }

        public Object targetObject => targetObjects[0];
        public Object[] targetObjects { get; }
        public void Dispose() { }

        public SerializedProperty FindProperty(string propertyPath)
        {
            var property = new SerializedProperty(this, "", Copies[0].Root);
            foreach (Match step in Regex.Matches(propertyPath, @"Array\.data\[(\d+)\]|\w+"))
            {
                var index = step.Groups[1];
                property = index.Success ? property?.GetArrayElementAtIndex(int.Parse(index.Value)) : property?.FindPropertyRelative(step.Value);
            }
            return property;
        }

        public void Update()
        {
            foreach (var copy in Copies) copy.Read();
        }

        public bool ApplyModifiedProperties()
        {
            var isChanged = false;
            foreach (var copy in Copies) isChanged |= copy.Apply();
            return isChanged;
        }
    }

    /// A field of the objects, or an element of a field that is a list.
    public class SerializedProperty
    {
        internal readonly Type Type;

        internal SerializedProperty(SerializedObject owner, string path, Type type)
        {
            serializedObject = owner;
            propertyPath = path;
            Type = type;
        }

        public SerializedObject serializedObject { get; }
        public string propertyPath { get; }
        public string name => propertyPath.EndsWith("]") ? "data" : propertyPath.Substring(propertyPath.LastIndexOf('.') + 1);
        public bool hasMultipleDifferentValues => Array.Exists(serializedObject.Copies, copy => !SerializedFields.Same(copy.Get(propertyPath), Value));
        public bool isArray => Value is IList;

        public int arraySize
        {
            get => List.Count;
            set => Change(list =>
            {
                while (list.Count > value) list.RemoveAt(list.Count - 1);
                while (list.Count < value) list.Add(NewElement(list.Count > 0 ? list[list.Count - 1] : null));
            });
        }

        public string stringValue
        {
            get => (string)Value ?? "";
            set => Value = value;
        }

        public Object objectReferenceValue
        {
            get => (Object)Value;
            set => Value = value == null || Type.IsInstanceOfType(value) ? value : null;
        }

        internal object Value
        {
            get => serializedObject.Copies[0].Get(propertyPath);
            set
            {
                foreach (var copy in serializedObject.Copies) copy.Set(propertyPath, value);
            }
        }

        IList List => (IList)Value;

        public SerializedProperty Copy() => this;

        public SerializedProperty FindPropertyRelative(string relativePropertyPath)
        {
            var field = SerializedFields.FieldOf(Type, relativePropertyPath);
            return field == null ? null
                : new SerializedProperty(serializedObject, propertyPath.Length > 0 ? propertyPath + "." + field.Name : field.Name, field.FieldType);
        }

        public SerializedProperty GetArrayElementAtIndex(int index) =>
            new SerializedProperty(serializedObject, propertyPath + ".Array.data[" + index + "]", SerializedFields.ElementOf(Type));

        public void InsertArrayElementAtIndex(int index) =>
            Change(list => list.Insert(index, NewElement(list.Count > 0 ? list[Math.Max(0, index - 1)] : null)));

        public void DeleteArrayElementAtIndex(int index) => Change(list => list.RemoveAt(index));

        /// Inserts a copy of the previous element.
        object NewElement(object before)
        {
            var type = SerializedFields.ElementOf(Type);
            if (before != null) return SerializedFields.Copy(before);
            return typeof(Object).IsAssignableFrom(type) ? null : type == typeof(string) ? "" : Activator.CreateInstance(type);
        }

        void Change(Action<IList> change)
        {
            foreach (var copy in serializedObject.Copies)
            {
                var list = (IList)copy.Get(propertyPath);
                change(list);
                copy.Set(propertyPath, list);
            }
        }
    }
}
