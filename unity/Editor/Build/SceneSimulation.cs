using System.Collections.Generic;
using Collektive.Bridge;
using UnityEditor.Build;
using UnityEditor.SceneManagement;
using UnityEngine.SceneManagement;

namespace Collektive.Unity.Editor
{
    /// <summary>A Simulation Manager in a scene of a player build.</summary>
    internal sealed class SceneSimulation
    {
        private SceneSimulation(string scene, SimulationSettings settings)
        {
            Scene = scene;
            Settings = settings;
        }

        /// <summary>The scene's path, relative to the project's folder.</summary>
        internal string Scene { get; }

        internal SimulationSettings Settings { get; }

        /// <summary>Whether the simulation uses the package's JVM rather than one installed on the machine.</summary>
        internal bool NeedsJvm
        {
            get
            {
                var location = Settings.jvm == null ? JvmLocation.Automatic : Settings.jvm.settings.location;
                return location == JvmLocation.Automatic || location == JvmLocation.Bundled;
            }
        }

        /// <summary>Returns the managers of the given scenes, as saved on disk. If no scene is given, returns the managers of the open scenes.</summary>
        internal static List<SceneSimulation> FindAll(string[] scenes)
        {
            var found = new List<SceneSimulation>();
            if (scenes == null || scenes.Length == 0)
            {
                for (var i = 0; i < SceneManager.sceneCount; i++)
                {
                    var scene = SceneManager.GetSceneAt(i);
                    if (scene.isLoaded) FindIn(scene, scene.path, found);
                }
                return found;
            }
            foreach (var path in scenes)
            {
                var scene = EditorSceneManager.OpenPreviewScene(path);
                try
                {
                    FindIn(scene, path, found);
                }
                finally
                {
                    EditorSceneManager.ClosePreviewScene(scene);
                }
            }
            return found;
        }

        internal BuildFailedException Failure(string problem) =>
            new BuildFailedException("the simulation of " + Scene + " cannot start in the player: " + problem);

        private static void FindIn(Scene scene, string path, List<SceneSimulation> found)
        {
            foreach (var root in scene.GetRootGameObjects())
            {
                foreach (var manager in root.GetComponentsInChildren<SimulationManager>(true)) found.Add(new SceneSimulation(path, manager.Settings));
            }
        }
    }
}
