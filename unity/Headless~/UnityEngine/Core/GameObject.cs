using System;
using System.Collections.Generic;
using UnityEngine.SceneManagement;

namespace UnityEngine
{
    public sealed class GameObject : Object
    {
        internal readonly List<Component> components = new List<Component>();
        /// The active body, if any, followed by the colliders; null until the first of them is added.
        internal List<Component> physicsParts;
        /// Messages that this object's scripts have methods for, including scripts that were removed.
        internal TouchMessages touchMessages;

        readonly Transform ownTransform;
        int ownLayer;
        string ownTag;
        bool ownActivity, activity, ownStatic;

        public GameObject() : this("New Game Object") { }

        public GameObject(string name) : this(name, true) { }

        public GameObject(string name, params Type[] components) : this(name, true)
        {
            foreach (var type in components) AddComponent(type);
        }

        internal GameObject(string name, bool active)
        {
            NameImpl = name;
            tag = "Untagged";
            activeSelf = active;
            activeInHierarchy = active && together == null;
            together?.Add(this);
            ownTransform = new Transform();
            Own(ownTransform);
            sceneOfRoot.Roots.Add(this);
        }

        public GameObject gameObject => this;
        /// The scene of an object without a parent.
        internal Scene sceneOfRoot = Scene.Active;

        public Scene scene => transform.root.owner.sceneOfRoot;
        public string tag { get => Existing.ownTag; set => Existing.ownTag = value; }
        public bool CompareTag(string tag) => this.tag == tag;
        public bool isStatic { get => Existing.ownStatic; set => Existing.ownStatic = value; }
        public bool activeSelf { get => Existing.ownActivity; private set => ownActivity = value; }
        public bool activeInHierarchy { get => Existing.activity; private set => activity = value; }

        public int layer
        {
            get => Existing.ownLayer;
            set
            {
                if (value < 0 || value > 31) throw new ArgumentOutOfRangeException(nameof(layer), value, "A layer must be from 0 to 31.");
                Existing.ownLayer = value;
                RefreshColliders();
            }
        }

        public Transform transform
        {
            get
            {
                ThrowIfDestroyed();
                return ownTransform;
            }
        }

        /// This object. Throws an exception if it is destroyed.
        GameObject Existing
        {
            get
            {
                ThrowIfDestroyed();
                return this;
            }
        }

        /// The transform, even while the object is being destroyed.
        internal Transform TransformUnchecked => ownTransform;

        // ---- Components ---------------------------------------------------------------------------------------------

        public T AddComponent<T>() where T : Component => (T)AddComponent(typeof(T));

        public Component AddComponent(Type componentType)
        {
            ThrowIfDestroyed();
            if (componentType == null || componentType.IsAbstract || !typeof(Component).IsAssignableFrom(componentType)
                || typeof(Transform).IsAssignableFrom(componentType))
            {
                Debug.LogError($"'{componentType}' is not a component that can be added to '{NameImpl}'.", this);
                return null;
            }
            if (Messages.SingleBase(componentType) is Type single && FindComponent(single) != null)
            {
                Debug.LogError($"'{NameImpl}' already has a {single.Name} and may have only one ([DisallowMultipleComponent]).", this);
                return null;
            }
            Adding.Add((this, componentType));
            try
            {
                foreach (RequireComponent required in componentType.GetCustomAttributes(typeof(RequireComponent), true))
                {
                    Require(required.m_Type0);
                    Require(required.m_Type1);
                    Require(required.m_Type2);
                }
            }
            finally
            {
                Adding.RemoveAt(Adding.Count - 1);
            }
            var component = (Component)Construction.Create(componentType);
            Own(component);
            if (component is Collider collider && GetComponent<MeshFilter>()?.sharedMesh is Mesh mesh && mesh && mesh.vertexCount > 0) collider.Fit(mesh);
            if (activeInHierarchy) component.Activate();
            return component;
        }

        /// The components whose required components are being added. They satisfy the requirements of those, because classes can require each other.
        static readonly List<(GameObject Owner, Type Type)> Adding = new List<(GameObject, Type)>();

        void Require(Type type)
        {
            if (type != null && !type.IsAbstract && FindComponent(type) is null
                && !Adding.Exists(added => ReferenceEquals(added.Owner, this) && type.IsAssignableFrom(added.Type))) AddComponent(type);
        }

        /// Returns a component with a [RequireComponent] that only the given component satisfies, or null.
        internal Component FindDependent(Component component)
        {
            return components.Find(other => !ReferenceEquals(other, component)
                && Array.Exists((RequireComponent[])other.GetType().GetCustomAttributes(typeof(RequireComponent), true),
                    required => IsAlone(required.m_Type0) || IsAlone(required.m_Type1) || IsAlone(required.m_Type2)));

            bool IsAlone(Type type) => type != null && type.IsInstanceOfType(component) && components.FindAll(type.IsInstanceOfType).Count == 1;
        }

        internal void Own(Component component)
        {
            component.owner = this;
            components.Add(component);
            if (!(component is MonoBehaviour script) || (touchMessages | script.messages.Touches) == touchMessages) return;
            touchMessages |= script.messages.Touches;
            RefreshColliders();
        }

        /// Updates the layer of colliders and the messages that physics must send.
        void RefreshColliders()
        {
            if (physicsParts == null) return;
            foreach (var part in physicsParts)
            {
                if (part is Rigidbody body) body.RefreshColliders();
                else ((Collider)part).Refresh();
            }
        }

        internal void AddPhysics(Component part)
        {
            if (physicsParts == null) physicsParts = new List<Component>();
            physicsParts.Insert(part is Rigidbody ? 0 : physicsParts.Count, part);
        }

        internal void RemovePhysics(Component part) => physicsParts.Remove(part);

        Component FindComponent(Type type)
        {
            foreach (var component in components)
                if (type.IsInstanceOfType(component)) return component;
            return null;
        }

        public T GetComponent<T>()
        {
            ThrowIfDestroyed();
            var count = components.Count;
            for (var index = 0; index < count; index++)
                if (components[index] is T component) return component;
            return default;
        }

        public Component GetComponent(Type type)
        {
            ThrowIfDestroyed();
            return FindComponent(type);
        }

        public bool TryGetComponent<T>(out T component)
        {
            component = GetComponent<T>();
            return component != null;
        }

        public bool TryGetComponent(Type type, out Component component)
        {
            component = GetComponent(type);
            return !(component is null);
        }

        public T[] GetComponents<T>()
        {
            var results = new List<T>();
            GetComponents(results);
            return results.ToArray();
        }

        public Component[] GetComponents(Type type)
        {
            var results = new List<Component>();
            GetComponents(type, results);
            return results.ToArray();
        }

        public void GetComponents<T>(List<T> results)
        {
            ThrowIfDestroyed();
            results.Clear();
            Collect(results);
        }

        public void GetComponents(Type type, List<Component> results)
        {
            ThrowIfDestroyed();
            results.Clear();
            foreach (var component in components)
                if (type.IsInstanceOfType(component)) results.Add(component);
        }

        void Collect<T>(List<T> results)
        {
            for (var index = 0; index < components.Count; index++)
                if (components[index] is T component) results.Add(component);
        }

        public T GetComponentInChildren<T>() => GetComponentInChildren<T>(false);
        public T GetComponentInChildren<T>(bool includeInactive) => FindInChildren(typeof(T), includeInactive) is T found ? found : default;
        public Component GetComponentInChildren(Type type) => GetComponentInChildren(type, false);
        public Component GetComponentInChildren(Type type, bool includeInactive) => FindInChildren(type, includeInactive);

        /// As in Unity, searches this object itself even if it is inactive.
        Component FindInChildren(Type type, bool includeInactive)
        {
            var own = GetComponent(type);
            if (!(own is null)) return own;
            foreach (var child in ownTransform.children)
            {
                var found = child.owner.activity || includeInactive ? child.owner.FindInChildren(type, includeInactive) : null;
                if (!(found is null)) return found;
            }
            return null;
        }

        public T[] GetComponentsInChildren<T>() => GetComponentsInChildren<T>(false);

        public T[] GetComponentsInChildren<T>(bool includeInactive)
        {
            var results = new List<T>();
            GetComponentsInChildren(includeInactive, results);
            return results.ToArray();
        }

        public void GetComponentsInChildren<T>(List<T> results) => GetComponentsInChildren(false, results);

        public void GetComponentsInChildren<T>(bool includeInactive, List<T> results)
        {
            ThrowIfDestroyed();
            results.Clear();
            CollectInChildren(includeInactive, results);
        }

        void CollectInChildren<T>(bool includeInactive, List<T> results)
        {
            Collect(results);
            foreach (var child in ownTransform.children)
                if (child.owner.activity || includeInactive) child.owner.CollectInChildren(includeInactive, results);
        }

        public T GetComponentInParent<T>() => GetComponentInParent<T>(false);

        public T GetComponentInParent<T>(bool includeInactive)
        {
            for (var level = transform; !(level is null); level = level.parentOrNull)
                if (IsSearched(level, includeInactive) && level.owner.GetComponent<T>() is T found) return found;
            return default;
        }

        public Component GetComponentInParent(Type type) => GetComponentInParent(type, false);

        public Component GetComponentInParent(Type type, bool includeInactive)
        {
            for (var level = transform; !(level is null); level = level.parentOrNull)
                if (IsSearched(level, includeInactive) && level.owner.FindComponent(type) is Component found) return found;
            return null;
        }

        public T[] GetComponentsInParent<T>() => GetComponentsInParent<T>(false);

        public T[] GetComponentsInParent<T>(bool includeInactive)
        {
            var results = new List<T>();
            GetComponentsInParent(includeInactive, results);
            return results.ToArray();
        }

        public void GetComponentsInParent<T>(bool includeInactive, List<T> results)
        {
            results.Clear();
            for (var level = transform; !(level is null); level = level.parentOrNull)
                if (IsSearched(level, includeInactive)) level.owner.Collect(results);
        }

        bool IsSearched(Transform level, bool includeInactive) => includeInactive || level.owner.activity || ReferenceEquals(level, ownTransform);

        // ---- Activity -----------------------------------------------------------------------------------------------

        public void SetActive(bool value)
        {
            ThrowIfDestroyed();
            if (activeSelf == value) return;
            activeSelf = value;
            if (isBeingDestroyed || !Lifecycle.IsDeactivating(ownTransform)) RefreshActivity();
            else Debug.LogError($"The GameObject '{NameImpl}' is already being activated or deactivated.", this);
        }

        /// Updates `activeInHierarchy` of this object and its descendants, then notifies their components.
        internal void RefreshActivity(bool locksParents = true)
        {
            var parent = ownTransform.parentOrNull;
            var active = activeSelf && !isBeingDestroyed && together == null && (parent is null || parent.owner.activeInHierarchy);
            if (active == activeInHierarchy) return;
            var affected = new List<Component>();
            MarkActivity(active, affected);
            Lifecycle.ActivityChanged(affected, active, locksParents ? ownTransform : null);
        }

        /// Activates a new copy. In contrast to `SetActive`, its scripts can change the parents of its objects.
        internal void ActivateCopy()
        {
            activeSelf = true;
            RefreshActivity(false);
        }

        void MarkActivity(bool active, List<Component> affected)
        {
            activeInHierarchy = active;
            affected.AddRange(components);
            foreach (var child in ownTransform.children)
                if (child.owner.activeSelf) child.owner.MarkActivity(active, affected);
        }

        static List<GameObject> together;

        /// Runs `build`. The objects that it creates are inactive until it returns. They then become active together, like the objects of a scene file.
        internal static void CreateTogether(Action build)
        {
            var created = together = new List<GameObject>();
            try
            {
                build();
            }
            finally
            {
                together = null;
            }
            var affected = new List<Component>();
            foreach (var root in created)
                if (root && root.ownTransform.parentOrNull is null && !root.activeInHierarchy && root.activeSelf) root.MarkActivity(true, affected);
            Lifecycle.ActivityChanged(affected, true, null);
        }

        // ---- Search and primitives ----------------------------------------------------------------------------------

        public static GameObject Find(string name)
        {
            Construction.Check(nameof(Find));
            if (string.IsNullOrEmpty(name)) return null;
            var path = name.TrimStart('/');
            foreach (var root in Scene.AllRoots())
                if (FindActive(root, path, path.Length < name.Length) is GameObject found) return found;
            return null;
        }

        /// Finds an active object by its name or path. If `isHere`, the path begins at `start`, otherwise at `start` or a descendant.
        static GameObject FindActive(GameObject start, string path, bool isHere)
        {
            if (!start.activeInHierarchy) return null;
            var name = start.NameImpl;
            if (name == path) return start;
            var continues = path.Length > name.Length && path[name.Length] == '/' && path.StartsWith(name, StringComparison.Ordinal);
            foreach (var child in start.ownTransform.children)
            {
                if (continues && FindActive(child.owner, path.Substring(name.Length + 1), true) is GameObject end) return end;
                if (!isHere && FindActive(child.owner, path, false) is GameObject found) return found;
            }
            return null;
        }

        /// Creates an object with Unity's mesh and collider of the primitive.
        public static GameObject CreatePrimitive(PrimitiveType type)
        {
            var primitive = new GameObject(type.ToString());
            primitive.AddComponent<MeshFilter>().sharedMesh = Mesh.Primitive(type);
            primitive.AddComponent<MeshRenderer>().sharedMaterial = Material.Default;
            switch (type)
            {
                case PrimitiveType.Sphere:
                    primitive.AddComponent<SphereCollider>();
                    break;
                case PrimitiveType.Capsule:
                case PrimitiveType.Cylinder:
                    primitive.AddComponent<CapsuleCollider>();
                    break;
                case PrimitiveType.Cube:
                    primitive.AddComponent<BoxCollider>();
                    break;
                case PrimitiveType.Plane:
                case PrimitiveType.Quad:
                    primitive.AddComponent<MeshCollider>();
                    break;
            }
            return primitive;
        }
    }

    public enum PrimitiveType
    {
        Sphere = 0,
        Capsule = 1,
        Cylinder = 2,
        Cube = 3,
        Plane = 4,
        Quad = 5,
    }
}
