using UnityEngine.Headless;
using UnityEngine.SceneManagement;

namespace UnityEditor.SceneManagement
{
    public enum OpenSceneMode
    {
        Single,
        Additive,
    }

    public sealed class EditorSceneManager
    {
        public delegate void SceneOpenedCallback(Scene scene, OpenSceneMode mode);

        public static event SceneOpenedCallback sceneOpened;

        /// Adds the objects of the file to the scene. This stand-in has only one scene.
        public static Scene OpenScene(string scenePath)
        {
            Headless.SceneFile.Load(scenePath);
            Loop.ScenePath = scenePath;
            sceneOpened?.Invoke(SceneManager.GetActiveScene(), OpenSceneMode.Single);
            return SceneManager.GetActiveScene();
        }

        public static Scene OpenPreviewScene(string scenePath) => PreviewScene.Open(() => Headless.SceneFile.Load(scenePath));

        public static bool ClosePreviewScene(Scene scene) => PreviewScene.Close(scene);
    }
}
