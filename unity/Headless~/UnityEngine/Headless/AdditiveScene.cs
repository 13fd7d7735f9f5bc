using System;
using UnityEngine.SceneManagement;

namespace UnityEngine.Headless
{
    /// Loads scenes in addition to the player's scene.
    public static class AdditiveScene
    {
        /// Loads a scene with the objects that `build` creates. The objects become active together.
        public static Scene Load(string name, Action build)
        {
            var before = Scene.Active;
            var scene = Scene.Active = new Scene(name);
            Scene.Loaded.Add(scene);
            try
            {
                GameObject.CreateTogether(build);
            }
            finally
            {
                Scene.Active = before;
            }
            SceneManager.RaiseLoaded(scene, LoadSceneMode.Additive);
            return scene;
        }

        public static void Unload(Scene scene)
        {
            foreach (var root in scene.GetRootGameObjects()) Object.DestroyImmediate(root);
            Scene.Loaded.Remove(scene);
            SceneManager.RaiseUnloaded(scene);
        }
    }
}
