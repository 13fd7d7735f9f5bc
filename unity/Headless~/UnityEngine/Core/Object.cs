using System;
using System.Runtime.CompilerServices;

namespace UnityEngine
{
    [Flags]
    public enum HideFlags
    {
        None = 0,
        HideInHierarchy = 1,
        HideInInspector = 2,
        DontSaveInEditor = 4,
        NotEditable = 8,
        DontSaveInBuild = 16,
        DontUnloadUnusedAsset = 32,
        DontSave = DontSaveInEditor | DontSaveInBuild | DontUnloadUnusedAsset,
        HideAndDontSave = HideInHierarchy | DontSaveInEditor | NotEditable | DontSaveInBuild | DontUnloadUnusedAsset,
    }

    public enum FindObjectsInactive
    {
        Exclude = 0,
        Include = 1,
    }

    public enum FindObjectsSortMode
    {
        None = 0,
        InstanceID = 1,
    }

    /// Base of all objects of the engine. A destroyed object still exists in C#, but compares equal to null, and using it throws an exception.
    public class Object
    {
        static int created;

        internal readonly int id = ++created;
        internal bool destroyed, isBeingDestroyed;
        string ownName = "";
        HideFlags ownHideFlags;

        internal static void ForgetCount() => created = 0;

        public HideFlags hideFlags { get => this.Existing().ownHideFlags; set => this.Existing().ownHideFlags = value; }

        public string name
        {
            get
            {
                ThrowIfDestroyed();
                return NameImpl;
            }
            set
            {
                ThrowIfDestroyed();
                NameImpl = value;
            }
        }

        internal virtual string NameImpl { get => ownName; set => ownName = value ?? ""; }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        internal void ThrowIfDestroyed()
        {
            if (destroyed) ThrowDestroyed();
        }

        void ThrowDestroyed() =>
            throw new MissingReferenceException($"The object of type '{GetType().Name}' has been destroyed but you are still trying to access it.");

        public override int GetHashCode() => id;
        public override bool Equals(object other) => other is null ? this == null : other is Object o && this == o;
        public override string ToString() => destroyed ? "null" : $"{NameImpl} ({GetType().FullName})";

        public static implicit operator bool(Object exists) => !(exists is null) && !exists.destroyed;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static bool operator ==(Object x, Object y)
        {
            if (x is null) return y is null || y.destroyed;
            return y is null ? x.destroyed : ReferenceEquals(x, y);
        }

        public static bool operator !=(Object x, Object y) => !(x == y);

        public static Object Instantiate(Object original) => Cloner.Clone(original, null, null);
        public static Object Instantiate(Object original, Transform parent) => Instantiate(original, parent, false);
        public static Object Instantiate(Object original, Transform parent, bool instantiateInWorldSpace) =>
            Cloner.Clone(original, parent, null, instantiateInWorldSpace);
        public static Object Instantiate(Object original, Vector3 position, Quaternion rotation) => Instantiate(original, position, rotation, null);
        public static Object Instantiate(Object original, Vector3 position, Quaternion rotation, Transform parent) =>
            Cloner.Clone(original, parent, (position, rotation));
        public static T Instantiate<T>(T original) where T : Object => (T)Instantiate((Object)original);
        public static T Instantiate<T>(T original, Transform parent) where T : Object => (T)Instantiate((Object)original, parent);
        public static T Instantiate<T>(T original, Transform parent, bool worldPositionStays) where T : Object =>
            (T)Instantiate((Object)original, parent, worldPositionStays);
        public static T Instantiate<T>(T original, Vector3 position, Quaternion rotation) where T : Object =>
            (T)Instantiate((Object)original, position, rotation);
        public static T Instantiate<T>(T original, Vector3 position, Quaternion rotation, Transform parent) where T : Object =>
            (T)Instantiate((Object)original, position, rotation, parent);

        public static void Destroy(Object obj) => Destroy(obj, 0f);

        public static void Destroy(Object obj, float t)
        {
            if (obj) Destruction.Schedule(obj, t);
        }

        public static void DestroyImmediate(Object obj) => DestroyImmediate(obj, false);

        public static void DestroyImmediate(Object obj, bool allowDestroyingAssets)
        {
            if (!obj) return;
            if (PhysicsWorld.IsStepping) Debug.LogError("DestroyImmediate is not permitted in physics messages, such as OnCollisionEnter: call Destroy.", obj);
            else Destruction.Destroy(obj);
        }

        public static void DontDestroyOnLoad(Object target) { } // the player's scene is never replaced

        /// Finds objects in scenes only, not assets or objects with HideFlags.DontSave.
        public static T[] FindObjectsByType<T>(FindObjectsSortMode sortMode) where T : Object =>
            FindObjectsByType<T>(FindObjectsInactive.Exclude, sortMode);

        public static T[] FindObjectsByType<T>(FindObjectsInactive findObjectsInactive, FindObjectsSortMode sortMode) where T : Object
        {
            var inactiveToo = findObjectsInactive == FindObjectsInactive.Include;
            var found = new System.Collections.Generic.List<T>();
            foreach (var root in SceneManagement.Scene.AllRoots())
            {
                if (!inactiveToo && !root.activeInHierarchy) continue;
                if (typeof(T) != typeof(GameObject)) found.AddRange(root.GetComponentsInChildren<T>(inactiveToo));
                else foreach (var transform in root.GetComponentsInChildren<Transform>(inactiveToo)) found.Add((T)(Object)transform.owner);
            }
            found.RemoveAll(one => IsUnsaved(one));
            if (sortMode == FindObjectsSortMode.InstanceID) found.Sort((a, b) => a.id.CompareTo(b.id));
            return found.ToArray();
        }

        public static T FindAnyObjectByType<T>() where T : Object => FindAnyObjectByType<T>(FindObjectsInactive.Exclude);
        public static T FindAnyObjectByType<T>(FindObjectsInactive findObjectsInactive) where T : Object =>
            (T)FindAnyObjectByType(typeof(T), findObjectsInactive);
        public static Object FindAnyObjectByType(Type type) => FindAnyObjectByType(type, FindObjectsInactive.Exclude);

        public static Object FindAnyObjectByType(Type type, FindObjectsInactive findObjectsInactive)
        {
            var inactiveToo = findObjectsInactive == FindObjectsInactive.Include;
            foreach (var root in SceneManagement.Scene.AllRoots())
            {
                if (!inactiveToo && !root.activeInHierarchy) continue;
                foreach (var transform in root.GetComponentsInChildren<Transform>(inactiveToo))
                {
                    if (type == typeof(GameObject) && !IsUnsaved(transform.owner)) return transform.owner;
                    foreach (var component in transform.owner.components)
                        if (type.IsInstanceOfType(component) && !IsUnsaved(component)) return component;
                }
            }
            return null;
        }

        static bool IsUnsaved(Object one) =>
            (one.ownHideFlags & HideFlags.DontSave) == HideFlags.DontSave || one is Component component && IsUnsaved(component.owner);
    }
}
