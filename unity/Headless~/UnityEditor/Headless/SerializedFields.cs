using System;
using System.Collections;
using System.Collections.Generic;
using System.Reflection;
using System.Text.RegularExpressions;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor.Headless
{
    /// A copy of an object's serialised fields.
    sealed class SerializedFields
    {
        const BindingFlags Own = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;

        readonly Object target;
        readonly Dictionary<string, object> values = new Dictionary<string, object>();

        internal SerializedFields(Object target)
        {
            this.target = target;
            Read();
        }

        internal Type Root => target.GetType();

        internal void Read()
        {
            values.Clear();
            foreach (var field in FieldsOf(Root)) values[field.Name] = Copy(field.GetValue(target));
        }

        /// Writes the changed fields, so that Undo can revert them.
        internal bool Apply()
        {
            var before = new Dictionary<FieldInfo, object>();
            foreach (var field in FieldsOf(Root))
            {
                var old = field.GetValue(target);
                if (Same(old, values[field.Name])) continue;
                before[field] = Copy(old);
                Write(target, field, values[field.Name]);
            }
            if (before.Count == 0) return false;
            Project.RecordUndo(() =>
            {
                foreach (var change in before) Write(target, change.Key, change.Value);
            });
            return true;
        }

        internal object Get(string path)
        {
            object value = null;
            foreach (var step in StepsOf(path)) value = value == null ? values[step] : At(value, step);
            return value;
        }

        internal void Set(string path, object value)
        {
            var steps = StepsOf(path);
            values[steps[0]] = Changed(values[steps[0]], steps, 1, value);
        }

        /// Changes a field. Returns the owner of the field, or a changed copy of the owner if it is a struct.
        static object Changed(object owner, List<string> steps, int at, object value)
        {
            if (at == steps.Count) return value;
            var changed = Changed(At(owner, steps[at]), steps, at + 1, value);
            if (owner is IList list) list[int.Parse(steps[at])] = changed;
            else FieldOf(owner.GetType(), steps[at]).SetValue(owner, changed);
            return owner;
        }

        static object At(object owner, string step) => owner is IList list ? list[int.Parse(step)] : FieldOf(owner.GetType(), step).GetValue(owner);

        static List<string> StepsOf(string path)
        {
            var steps = new List<string>();
            foreach (Match step in Regex.Matches(path, @"Array\.data\[(\d+)\]|\w+"))
                steps.Add(step.Groups[1].Success ? step.Groups[1].Value : step.Value);
            return steps;
        }

        /// Writes a field. Existing objects and lists are kept, and filled with the new content.
        static void Write(object owner, FieldInfo field, object value)
        {
            var old = field.GetValue(owner);
            if (old is IList list && !(old is Array) && value is IList items)
            {
                list.Clear();
                foreach (var item in items) list.Add(Copy(item));
            }
            else if (IsObject(old) && !old.GetType().IsValueType && value != null)
            {
                foreach (var part in FieldsOf(old.GetType())) Write(old, part, part.GetValue(value));
            }
            else field.SetValue(owner, Copy(value));
        }

        internal static FieldInfo FieldOf(Type type, string name) => FieldsOf(type).Find(field => field.Name == name);

        internal static Type ElementOf(Type list) => list.IsArray ? list.GetElementType() : list.GetGenericArguments()[0];

        /// Returns the serialised fields of a type. As in the inspector, fields of base classes come first.
        internal static List<FieldInfo> FieldsOf(Type type)
        {
            var fields = new List<FieldInfo>();
            for (; type != null && type.Assembly != typeof(Object).Assembly && type != typeof(object); type = type.BaseType)
            {
                fields.InsertRange(0, Array.FindAll(type.GetFields(Own), field => !field.IsInitOnly && !field.IsNotSerialized
                    && (field.IsPublic || field.IsDefined(typeof(SerializeField))) && !typeof(Delegate).IsAssignableFrom(field.FieldType)
                    && !typeof(IDictionary).IsAssignableFrom(field.FieldType)));
            }
            return fields;
        }

        internal static object Copy(object value)
        {
            if (value is IList list && !(value is Array))
            {
                var items = (IList)Activator.CreateInstance(value.GetType());
                foreach (var item in list) items.Add(Copy(item));
                return items;
            }
            if (!IsObject(value)) return value is Array array ? array.Clone() : value;
            var copy = Activator.CreateInstance(value.GetType(), true);
            foreach (var field in FieldsOf(value.GetType())) field.SetValue(copy, Copy(field.GetValue(value)));
            return copy;
        }

        internal static bool Same(object a, object b)
        {
            if (a is IList first && b is IList second)
            {
                if (first.Count != second.Count) return false;
                for (var i = 0; i < first.Count; i++)
                    if (!Same(first[i], second[i])) return false;
                return true;
            }
            return IsObject(a) && IsObject(b) ? FieldsOf(a.GetType()).TrueForAll(field => Same(field.GetValue(a), field.GetValue(b))) : Equals(a, b);
        }

        /// Returns whether the value is an object with serialised fields.
        internal static bool IsObject(object value) => value != null && !(value is Object) && !(value is string) && !(value is IList)
            && !value.GetType().IsPrimitive && !value.GetType().IsEnum && value.GetType().IsDefined(typeof(SerializableAttribute), false);
    }
}
