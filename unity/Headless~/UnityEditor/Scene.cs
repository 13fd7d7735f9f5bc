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
        public static void RegisterCreatedObjectUndo(Object objectToUndo, string name) => Headless.Project.Undoable.Add(name);
    }

    public sealed class GameObjectUtility
    {
        public static void SetParentAndAlign(GameObject child, GameObject parent)
        {
            if (parent == null) return;
            child.transform.SetParent(parent.transform, false);
            child.layer = parent.layer;
        }

        public static void EnsureUniqueNameForSibling(GameObject self)
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
        /// Each loading of a prefab makes a new object: it becomes the copy.
        public static Object InstantiatePrefab(Object assetComponentOrGameObject)
        {
            ((GameObject)assetComponentOrGameObject).SetActive(true);
            return assetComponentOrGameObject;
        }
    }
}
