using System;
using UnityEngine.SceneManagement;

namespace UnityEngine.Headless
{
    /// Creates preview scenes like the editor's, which do not run in play mode.
    public static class PreviewScene
    {
        public static Scene Open(Action build)
        {
            var before = Scene.Active;
            var scene = Scene.Active = new Scene("");
            try
            {
                build();
            }
            finally
            {
                Scene.Active = before;
            }
            return scene;
        }

        public static bool Close(Scene scene)
        {
            foreach (var root in scene.GetRootGameObjects()) Object.DestroyImmediate(root);
            return true;
        }
    }
}
