using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;

namespace UnityEngine
{
    public class Component : Object
    {
        internal GameObject owner;

        public GameObject gameObject
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get
            {
                ThrowIfDestroyed();
                return owner;
            }
        }

        public Transform transform => gameObject.TransformUnchecked;
        public string tag { get => gameObject.tag; set => gameObject.tag = value; }
        public bool CompareTag(string tag) => gameObject.CompareTag(tag);

        internal override string NameImpl { get => owner.NameImpl; set => owner.NameImpl = value; }

        /// Called when the object becomes active, or when the component is added to an active object.
        internal virtual void Activate() { }

        /// Called when the object becomes inactive, or before the component is destroyed.
        internal virtual void Deactivate() { }

        /// Copies the values of a built-in component for `Instantiate`. Scripts do not override this method; their fields are copied one by one.
        internal virtual void CopyFrom(Component original) { }

        public T GetComponent<T>() => gameObject.GetComponent<T>();
        public Component GetComponent(Type type) => gameObject.GetComponent(type);
        public int GetComponentIndex() => gameObject.components.IndexOf(this);
        public bool TryGetComponent<T>(out T component) => gameObject.TryGetComponent(out component);
        public bool TryGetComponent(Type type, out Component component) => gameObject.TryGetComponent(type, out component);
        public T[] GetComponents<T>() => gameObject.GetComponents<T>();
        public Component[] GetComponents(Type type) => gameObject.GetComponents(type);
        public void GetComponents<T>(List<T> results) => gameObject.GetComponents(results);
        public void GetComponents(Type type, List<Component> results) => gameObject.GetComponents(type, results);
        public T GetComponentInChildren<T>() => gameObject.GetComponentInChildren<T>();
        public T GetComponentInChildren<T>(bool includeInactive) => gameObject.GetComponentInChildren<T>(includeInactive);
        public Component GetComponentInChildren(Type t) => gameObject.GetComponentInChildren(t);
        public Component GetComponentInChildren(Type t, bool includeInactive) => gameObject.GetComponentInChildren(t, includeInactive);
        public T[] GetComponentsInChildren<T>() => gameObject.GetComponentsInChildren<T>();
        public T[] GetComponentsInChildren<T>(bool includeInactive) => gameObject.GetComponentsInChildren<T>(includeInactive);
        public void GetComponentsInChildren<T>(List<T> results) => gameObject.GetComponentsInChildren(results);
        public void GetComponentsInChildren<T>(bool includeInactive, List<T> result) => gameObject.GetComponentsInChildren(includeInactive, result);
        public T GetComponentInParent<T>() => gameObject.GetComponentInParent<T>();
        public T GetComponentInParent<T>(bool includeInactive) => gameObject.GetComponentInParent<T>(includeInactive);
        public Component GetComponentInParent(Type t) => gameObject.GetComponentInParent(t);
        public Component GetComponentInParent(Type t, bool includeInactive) => gameObject.GetComponentInParent(t, includeInactive);
        public T[] GetComponentsInParent<T>() => gameObject.GetComponentsInParent<T>();
        public T[] GetComponentsInParent<T>(bool includeInactive) => gameObject.GetComponentsInParent<T>(includeInactive);
        public void GetComponentsInParent<T>(bool includeInactive, List<T> results) => gameObject.GetComponentsInParent(includeInactive, results);
    }
}
