using System;
using System.Collections.Generic;
using System.IO;
using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;
using UnityEngine.SceneManagement;

namespace Collektive.Unity.Editor
{
    /// <summary>
    /// Migrates scenes of earlier versions, and their prefabs, when a scene is opened and before Play. Names of programs and jars are replaced with
    /// references. Names without a matching library are kept and reported.
    /// </summary>
    internal static class ProgramNames
    {
        /// <summary>Name of the jar that contained all samples in earlier versions.</summary>
        private const string SamplesJar = "collektive-samples.jar";

        [InitializeOnLoadMethod]
        private static void Listen()
        {
            EditorSceneManager.sceneOpened -= Opened;
            EditorSceneManager.sceneOpened += Opened;
            EditorApplication.playModeStateChanged -= Changed;
            EditorApplication.playModeStateChanged += Changed;
        }

        private static void Opened(Scene scene, OpenSceneMode mode) => Replace(scene);

        private static void Changed(PlayModeStateChange change)
        {
            if (change != PlayModeStateChange.ExitingEditMode) return;
            for (var i = 0; i < SceneManager.sceneCount; i++) Replace(SceneManager.GetSceneAt(i));
        }

        private static void Replace(Scene scene)
        {
            // The Hierarchy window can also contain scenes that are not loaded.
            if (!scene.isLoaded) return;
            var prefabs = PrefabsOf(scene);
            var roots = scene.GetRootGameObjects();
            var unknown = new HashSet<string>();
            // Prefabs must be saved first, because instances in the scene inherit their values.
            var settings = ReplaceInManagers(prefabs, new SimulationSettings());
            settings = ReplaceInManagers(roots, settings);
            ReplaceInNodes(prefabs, settings, unknown);
            ReplaceInNodes(roots, settings, unknown);
        }

        /// <summary>Returns the prefabs of the project that a saved scene refers to.</summary>
        private static GameObject[] PrefabsOf(Scene scene)
        {
            if (scene.path.Length == 0) return new GameObject[0];
            var paths = AssetDatabase.GetDependencies(new[] { scene.path }, true);
            paths = Array.FindAll(paths, path => path.StartsWith("Assets/", StringComparison.Ordinal) && path.EndsWith(".prefab", StringComparison.Ordinal));
            return Array.FindAll(Array.ConvertAll(paths, AssetDatabase.LoadAssetAtPath<GameObject>), prefab => prefab != null);
        }

        /// <returns>The settings of the last manager, or <paramref name="settings"/> if the objects have no manager.</returns>
        private static SimulationSettings ReplaceInManagers(GameObject[] roots, SimulationSettings settings)
        {
            foreach (var root in roots)
            {
                foreach (var manager in root.GetComponentsInChildren<SimulationManager>(true))
                {
                    settings = manager.Settings;
                    if (settings.jars.Count > 0 || settings.schema.Length > 0 || settings.program.Length > 0) Replace(manager);
                }
            }
            return settings;
        }

        private static void ReplaceInNodes(GameObject[] roots, SimulationSettings settings, HashSet<string> unknown)
        {
            foreach (var root in roots)
            {
                foreach (var node in root.GetComponentsInChildren<Node>(true))
                {
                    if (node.OwnProgram != null || node.Program.Length == 0 || TryReplace(node, settings.FindProgram(node.Program))) continue;
                    if (unknown.Add(node.Program))
                        Debug.LogWarning("node '" + node.name + "' names program '" + node.Program + "', which no library of the Simulation Manager contains: "
                            + "add the library, and select the program in the node", node);
                }
            }
        }

        private static void Replace(SimulationManager manager)
        {
            var settings = manager.Settings;
            var libraries = new List<ProgramLibrary>();
            foreach (var jar in settings.jars.Count > 0 ? settings.jars : new List<string> { "" })
            {
                var library = LibraryOf(jar, settings.schema);
                if (library == null)
                {
                    Debug.LogWarning("'" + manager.name + "' names " + (jar.Length > 0 ? "jar " + jar : "the jar of schema '" + settings.schema + "'")
                        + ", but Assets has no library of programs for it: choose Tools > Collektive > Rebuild Programs, or copy a jar to Assets with the "
                        + "extension ." + ProgramLibrary.Extension + ", and add it to Libraries", manager);
                    return;
                }
                if (!settings.libraries.Contains(library) && !libraries.Contains(library)) libraries.Add(library);
            }
            using (var target = new SerializedObject(manager))
            {
                var fields = target.FindProperty("settings");
                var list = fields.FindPropertyRelative(nameof(SimulationSettings.libraries));
                foreach (var library in libraries)
                {
                    list.InsertArrayElementAtIndex(list.arraySize);
                    list.GetArrayElementAtIndex(list.arraySize - 1).objectReferenceValue = library;
                }
                fields.FindPropertyRelative(nameof(SimulationSettings.jars)).arraySize = 0;
                fields.FindPropertyRelative(nameof(SimulationSettings.schema)).stringValue = "";
                target.ApplyModifiedProperties();
                var program = settings.FindProgram(settings.program);
                if (program != null)
                {
                    fields.FindPropertyRelative(nameof(SimulationSettings.defaultProgram)).objectReferenceValue = program;
                    fields.FindPropertyRelative(nameof(SimulationSettings.program)).stringValue = "";
                    target.ApplyModifiedProperties();
                }
                else if (settings.program.Length > 0)
                {
                    Debug.LogWarning(
                        "'" + manager.name + "' names program '" + settings.program + "', which none of its libraries contains: select another one", manager);
                }
            }
            Save(manager);
            Debug.Log("'" + manager.name + "' now refers to the libraries of its programs: save the scene", manager);
        }

        private static bool TryReplace(Node node, AggregateProgram program)
        {
            if (program == null) return false;
            using (var target = new SerializedObject(node))
            {
                target.FindProperty("ownProgram").objectReferenceValue = program;
                target.FindProperty("program").stringValue = "";
                target.ApplyModifiedProperties();
            }
            Save(node);
            return true;
        }

        /// <summary>Saves the prefab of a changed component. Does nothing for an object in a scene.</summary>
        private static void Save(Component component)
        {
            if (AssetDatabase.Contains(component)) AssetDatabase.SaveAssetIfDirty(component);
        }

        /// <summary>Returns the library that replaces a jar, or null if no library or several libraries match.</summary>
        private static ProgramLibrary LibraryOf(string jar, string schema)
        {
            var name = Path.GetFileNameWithoutExtension(jar).Replace("-collektive", "");
            ProgramLibrary found = null;
            foreach (var guid in AssetDatabase.FindAssets("t:" + nameof(ProgramLibrary)))
            {
                var path = AssetDatabase.GUIDToAssetPath(guid);
                var library = AssetDatabase.LoadAssetAtPath<ProgramLibrary>(path);
                if (path == jar) return library;
                var isNamed = jar.Length == 0 || Path.GetFileName(jar) == SamplesJar || library.name == name;
                if (!isNamed || schema.Length > 0 && library.Schema != schema) continue;
                if (found != null) return null;
                found = library;
            }
            return found;
        }
    }
}
