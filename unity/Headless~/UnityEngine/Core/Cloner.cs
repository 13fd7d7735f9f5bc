using System;
using System.Collections;
using System.Collections.Generic;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.Serialization;

namespace UnityEngine
{
    /// Implements `Instantiate` by copying serialised data. References to objects within the copied hierarchy are replaced with references to their copies.
    /// All other references are kept.
    sealed class Cloner
    {
        const int MaxDepth = 10;

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
                    var copy = (ScriptableObject)Construction.Create(script.GetType());
                    copy.name = script.name + "(Clone)";
                    cloner.CopyScript(script, copy, typeof(ScriptableObject));
                    copy.Awaken();
                    return copy;
                case Material material:
                    return new Material(material) { name = material.name + "(Clone)" };
                case Mesh mesh:
                    return mesh.Copy(mesh.name + "(Clone)");
                default:
                    throw new NotSupportedException($"The headless player cannot instantiate a {original.GetType().Name}.");
            }
        }

        GameObject CloneHierarchy(GameObject original, Transform parent, (Vector3 position, Quaternion rotation)? pose, bool worldPositionStays)
        {
            var copy = CopyObjects(original);
            var transform = copy.transform;
            copy.name = original.name + "(Clone)";
            transform.Join(parent ? parent : null, worldPositionStays);
            if (pose.HasValue) transform.SetPositionAndRotation(pose.Value.position, pose.Value.rotation);
            foreach (var pair in copies)
            {
                if (pair.Key is MonoBehaviour script) CopyScript(script, pair.Value, typeof(MonoBehaviour));
                else if (pair.Value is Joint joint) joint.connectedBody = (Rigidbody)CopyValue(joint.connectedBody, typeof(Rigidbody), false, 0);
            }
            if (original.activeSelf) copy.ActivateCopy();
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
                else copy.Own(added = (Component)Construction.Create(component.GetType()));
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
            CopyFields(original, copy, original.GetType(), stopAt, 0);
        }

        void CopyFields(object original, object copy, Type type, Type stopAt, int depth)
        {
            if (original is ISerializationCallbackReceiver serialized) Headless.Loop.InvokeAll(serialized.OnBeforeSerialize);
            for (var level = type; level != stopAt && level != typeof(object); level = level.BaseType)
                foreach (var field in level.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly))
                    if (IsSerialized(field))
                        field.SetValue(copy, CopyValue(field.GetValue(original), field.FieldType, field.IsDefined(typeof(SerializeReference)), depth,
                            field.GetValue(copy)));
            if (copy is ISerializationCallbackReceiver deserialized) Headless.Loop.InvokeAll(deserialized.OnAfterDeserialize);
        }

        static Type ListElement(Type type) =>
            type.IsGenericType && type.GetGenericTypeDefinition() == typeof(List<>) ? type.GetGenericArguments()[0] : null;

        static bool IsSerialized(FieldInfo field) =>
            !field.IsInitOnly && !field.IsNotSerialized
            && (field.IsDefined(typeof(SerializeReference))
                || (field.IsPublic || field.IsDefined(typeof(SerializeField))) && IsSerialized(field.FieldType, true));

        /// As in Unity, types of the class library are not serialised, except for primitive types, strings, and arrays and lists that are not nested.
        static bool IsSerialized(Type type, bool mayBeList)
        {
            if (type.IsPrimitive || type.IsEnum || type == typeof(string) || typeof(Object).IsAssignableFrom(type)) return true;
            var element = ListElement(type) ?? type.GetElementType();
            if (element != null) return mayBeList && (!type.IsArray || type.GetArrayRank() == 1) && IsSerialized(element, false);
            if (type == typeof(Ray) || type == typeof(RaycastHit)) return false;
            if (type.Assembly == typeof(Object).Assembly) return type.IsValueType && type.Namespace == nameof(UnityEngine);
            var library = type.Assembly.GetName().Name;
            return type.IsSerializable && !type.IsAbstract && !typeof(Delegate).IsAssignableFrom(type) && library != "mscorlib" && library != "System"
                && !library.StartsWith("System.", StringComparison.Ordinal);
        }

        /// As in Unity, copies of null are empty, and objects have the declared type, except for references. Values in each other end at a depth limit. A
        /// struct in a field keeps the fields of its current value that are not serialised.
        object CopyValue(object value, Type type, bool byReference, int depth, object current = null)
        {
            if (value is Object reference) return copies.TryGetValue(reference, out var copied) ? copied : reference;
            if (type == typeof(string)) return value ?? "";
            if (type.IsArray)
            {
                var element = type.GetElementType();
                var array = (Array)value ?? Array.CreateInstance(element, 0);
                var elements = Array.CreateInstance(element, array.Length);
                for (var index = 0; index < array.Length; index++) elements.SetValue(CopyValue(array.GetValue(index), element, byReference, depth), index);
                return elements;
            }
            if (ListElement(type) is Type item)
            {
                var items = (IList)Activator.CreateInstance(type);
                if (value != null)
                    foreach (var one in (IList)value) items.Add(CopyValue(one, item, byReference, depth));
                return items;
            }
            if (byReference && value != null) type = value.GetType();
            if (value == null && (byReference || typeof(Object).IsAssignableFrom(type)) || type.IsPrimitive || type.IsEnum) return value;
            if (!type.IsSerializable && !byReference) return value;
            if (byReference && references.TryGetValue(value, out var shared)) return shared;
            if (!byReference && depth == MaxDepth)
            {
                if (value != null && !type.IsValueType)
                    Debug.LogWarning($"Serialization depth limit {MaxDepth} exceeded at '{type.Name}'. There may be an object composition cycle.");
                return type.IsValueType ? value : null;
            }
            value ??= Create(type);
            var copy = type.IsValueType && current != null ? current : Create(type);
            if (byReference) references.Add(value, copy);
            CopyFields(value, copy, type, typeof(object), byReference ? 0 : depth + 1);
            return copy;
        }

        /// As in Unity, classes need no constructor without parameters.
        static object Create(Type type) =>
            type.IsValueType || type.GetConstructor(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic, null, Type.EmptyTypes, null) != null
                ? Construction.Create(type)
                : FormatterServices.GetUninitializedObject(type);

        sealed class Identity : IEqualityComparer<object>
        {
            bool IEqualityComparer<object>.Equals(object one, object other) => ReferenceEquals(one, other);

            int IEqualityComparer<object>.GetHashCode(object value) => RuntimeHelpers.GetHashCode(value);
        }
    }
}
