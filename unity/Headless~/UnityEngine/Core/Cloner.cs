using System;
using System.Collections;
using System.Collections.Generic;
using System.Reflection;
using System.Runtime.CompilerServices;

namespace UnityEngine
{
    /// Implements `Instantiate` by copying serialised data. References to objects within the copied hierarchy are replaced with references to their copies.
    /// All other references are kept.
    sealed class Cloner
    {
        readonly Dictionary<Object, Object> copies = new Dictionary<Object, Object>();

        /// The copies of the values of fields with `SerializeReference`. As in Unity, fields of one script that share a value share its copy.
        readonly Dictionary<object, object> references = new Dictionary<object, object>(new Identity());

        public static Object Clone(Object original, Transform parent, (Vector3 position, Quaternion rotation)? pose, bool worldPositionStays = false)
        {
            if (!original) throw new ArgumentException("The Object you want to instantiate is null.");
            var cloner = new Cloner();
            switch (original)
            {
                case GameObject gameObject:
                    return cloner.CloneHierarchy(gameObject, parent, pose, worldPositionStays);
                case Component component:
                    cloner.CloneHierarchy(component.gameObject, parent, pose, worldPositionStays);
                    return cloner.copies[component];
                case ScriptableObject script:
                    var copy = (ScriptableObject)Activator.CreateInstance(script.GetType(), true);
                    copy.name = script.name + "(Clone)";
                    cloner.CopyScript(script, copy, typeof(ScriptableObject));
                    return copy;
                case Material material:
                    return new Material(material) { name = material.name + "(Clone)" };
                default:
                    throw new NotSupportedException($"The headless player cannot instantiate a {original.GetType().Name}.");
            }
        }

        GameObject CloneHierarchy(GameObject original, Transform parent, (Vector3 position, Quaternion rotation)? pose, bool worldPositionStays)
        {
            var copy = CopyObjects(original);
            var transform = copy.transform;
            copy.name = original.name + "(Clone)";
            transform.SetParent(parent, worldPositionStays);
            if (pose.HasValue) transform.Place(pose.Value.position, pose.Value.rotation);
            foreach (var pair in copies)
            {
                if (pair.Key is MonoBehaviour script) CopyScript(script, pair.Value, typeof(MonoBehaviour));
                else if (pair.Value is Joint joint) joint.connectedBody = (Rigidbody)CopyValue(joint.connectedBody, false);
            }
            copy.SetActive(original.activeSelf);
            return copy;
        }

        /// Creates inactive objects and components, so that no message is sent before the fields are set.
        GameObject CopyObjects(GameObject original)
        {
            var copy = new GameObject(original.name, false) { layer = original.layer, tag = original.tag, isStatic = original.isStatic };
            copies.Add(original, copy);
            foreach (var component in original.components)
            {
                Component added;
                if (component is Transform) added = copy.transform;
                else copy.Own(added = (Component)Activator.CreateInstance(component.GetType(), true));
                added.hideFlags = component.hideFlags;
                if (component is Behaviour behaviour) ((Behaviour)added).ownEnabled = behaviour.ownEnabled;
                added.CopyFrom(component);
                copies.Add(component, added);
            }
            foreach (var child in original.transform.children)
            {
                var copiedChild = CopyObjects(child.owner);
                copiedChild.transform.SetParent(copy.transform, false);
                copiedChild.SetActive(child.owner.activeSelf);
            }
            return copy;
        }

        void CopyScript(Object original, Object copy, Type stopAt)
        {
            references.Clear();
            CopyFields(original, copy, stopAt);
        }

        void CopyFields(object original, object copy, Type stopAt)
        {
            if (original is ISerializationCallbackReceiver serialized) Headless.Loop.InvokeAll(serialized.OnBeforeSerialize);
            for (var level = original.GetType(); level != stopAt && level != typeof(object); level = level.BaseType)
                foreach (var field in level.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly))
                    if (IsSerialized(field)) field.SetValue(copy, CopyValue(field.GetValue(original), field.IsDefined(typeof(SerializeReference))));
            if (copy is ISerializationCallbackReceiver deserialized) Headless.Loop.InvokeAll(deserialized.OnAfterDeserialize);
        }

        static bool IsSerialized(FieldInfo field) =>
            !field.IsInitOnly && !field.IsNotSerialized
            && (field.IsDefined(typeof(SerializeReference))
                || (field.IsPublic || field.IsDefined(typeof(SerializeField))) && IsSerialized(field.FieldType, true));

        /// As in Unity, types of the class library are not serialised, except for primitive types, strings, and arrays and lists that are not nested.
        static bool IsSerialized(Type type, bool mayBeList)
        {
            if (type.IsPrimitive || type.IsEnum || type == typeof(string) || typeof(Object).IsAssignableFrom(type)) return true;
            var element = type.IsGenericType && type.GetGenericTypeDefinition() == typeof(List<>) ? type.GetGenericArguments()[0] : type.GetElementType();
            if (element != null) return mayBeList && (!type.IsArray || type.GetArrayRank() == 1) && IsSerialized(element, false);
            if (type.Assembly == typeof(Object).Assembly) return type.IsValueType;
            var library = type.Assembly.GetName().Name;
            return type.IsSerializable && !typeof(Delegate).IsAssignableFrom(type) && library != "mscorlib" && library != "System"
                && !library.StartsWith("System.", StringComparison.Ordinal);
        }

        object CopyValue(object value, bool byReference)
        {
            switch (value)
            {
                case null:
                case string _:
                    return value;
                case Object reference:
                    return copies.TryGetValue(reference, out var copied) ? copied : reference;
                case Array array:
                    var elements = Array.CreateInstance(array.GetType().GetElementType(), array.Length);
                    for (var index = 0; index < array.Length; index++) elements.SetValue(CopyValue(array.GetValue(index), byReference), index);
                    return elements;
                case IList list when value.GetType().IsGenericType:
                    var items = (IList)Activator.CreateInstance(value.GetType());
                    foreach (var item in list) items.Add(CopyValue(item, byReference));
                    return items;
            }
            var type = value.GetType();
            if (type.IsPrimitive || type.IsEnum) return value;
            if (!type.IsSerializable && !byReference) return value;
            if (byReference && references.TryGetValue(value, out var shared)) return shared;
            // A struct with callbacks must not share the objects that they restore.
            var copy = type.IsValueType && !(value is ISerializationCallbackReceiver) ? value : Activator.CreateInstance(type, true);
            if (byReference) references.Add(value, copy);
            CopyFields(value, copy, typeof(object));
            return copy;
        }

        sealed class Identity : IEqualityComparer<object>
        {
            bool IEqualityComparer<object>.Equals(object one, object other) => ReferenceEquals(one, other);

            int IEqualityComparer<object>.GetHashCode(object value) => RuntimeHelpers.GetHashCode(value);
        }
    }
}
