using UnityEngine.Headless;
using UnityEngine.SceneManagement;

namespace UnityEditor.SceneManagement
{
    public sealed class EditorSceneManager
    {
        public static Scene OpenPreviewScene(string scenePath) => PreviewScene.Open(() => Headless.SceneFile.Load(scenePath));

        public static bool ClosePreviewScene(Scene scene) => PreviewScene.Close(scene);
    }
}
