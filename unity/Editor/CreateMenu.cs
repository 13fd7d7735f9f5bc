using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>The menu GameObject &gt; Collektive, which adds the package's prefabs to the scene.</summary>
    internal static class CreateMenu
    {
        private const string Menu = "GameObject/Collektive/";
        private const int Priority = 10;

        // Prefabs are found by GUID, because the path of the package's folder depends on how the package was installed.
        internal const string ManagerPrefab = "de7f1c418113b5c64bd5634bfb1c00c4";
        internal const string NodePrefab = "4294b6f679fa2bac2a9edd1a9a796341";

        [MenuItem(Menu + "Simulation Manager", false, Priority)]
        private static void CreateManager(MenuCommand command)
        {
            if (SimulationManager.Current != null || Object.FindAnyObjectByType<SimulationManager>() != null)
            {
                Debug.LogWarning("the scene already has a Simulation Manager, and only one can run: no second one was created");
                return;
            }
            Create(ManagerPrefab, command);
        }

        [MenuItem(Menu + "Node", false, Priority)]
        internal static void CreateNode(MenuCommand command) => Create(NodePrefab, command);

        private static void Create(string guid, MenuCommand command)
        {
            var path = AssetDatabase.GUIDToAssetPath(guid);
            var prefab = AssetDatabase.LoadAssetAtPath<GameObject>(path);
            if (prefab == null)
            {
                Debug.LogError("the package's prefab with GUID " + guid + " is missing: reinstall the package");
                return;
            }
            var created = (GameObject)PrefabUtility.InstantiatePrefab(prefab);
            var scale = created.transform.localScale;
            var parent = command.context as GameObject;
            ObjectFactory.PlaceGameObject(created, parent != null && !EditorUtility.IsPersistent(parent) ? parent : null);
            // PlaceGameObject has reset the scale.
            created.transform.localScale = scale;
            Undo.RegisterCreatedObjectUndo(created, "Create " + created.name);
            Selection.activeGameObject = created;
        }
    }
}
