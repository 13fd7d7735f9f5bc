using UnityEngine;

namespace UnityEditor
{
    public sealed class MenuCommand
    {
        public Object context;
        public int userData;
        public MenuCommand(Object inContext) => context = inContext;
    }

    public sealed class Selection
    {
        public static GameObject activeGameObject { get; set; }
    }

    public class Undo
    {
        public delegate void UndoRedoCallback();

        public static UndoRedoCallback undoRedoPerformed;

        public static void RegisterCreatedObjectUndo(Object objectToUndo, string name) => Headless.Project.Undoable.Add(name);
    }

    public static class ObjectFactory
    {
        /// Makes the object a child of the parent, if any, and resets the position, rotation and scale. Then assigns a unique name and selects the object.
        public static void PlaceGameObject(GameObject go, GameObject parent = null)
        {
            if (parent != null)
            {
                if (EditorUtility.IsPersistent(parent)) throw new System.ArgumentException("'" + parent.name + "' is an asset", nameof(parent));
                go.transform.SetParent(parent.transform, false);
                go.transform.localPosition = Vector3.zero;
                go.transform.localRotation = Quaternion.identity;
                go.transform.localScale = Vector3.one;
                go.layer = parent.layer;
            }
            Name(go);
            Selection.activeGameObject = go;
        }

        static void Name(GameObject self)
        {
            var taken = new System.Collections.Generic.HashSet<string>();
            var parent = self.transform.parent;
            if (parent != null)
            {
                for (var i = 0; i < parent.childCount; i++)
                    if (parent.GetChild(i) != self.transform) taken.Add(parent.GetChild(i).name);
            }
            else
            {
                foreach (var root in self.scene.GetRootGameObjects())
                    if (root != self) taken.Add(root.name);
            }
            var name = self.name;
            for (var number = 1; taken.Contains(self.name); number++) self.name = name + " (" + number + ")";
        }
    }

    public sealed class PrefabUtility
    {
        /// Returns a new object without copying the prefab, because loading a prefab always creates a new object here.
        public static Object InstantiatePrefab(Object assetComponentOrGameObject)
        {
            Headless.PrefabFile.Loaded.Remove(assetComponentOrGameObject);
            ((GameObject)assetComponentOrGameObject).SetActive(true);
            return assetComponentOrGameObject;
        }
    }
}
