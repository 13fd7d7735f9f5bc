using System;
using UnityEngine.SceneManagement;

namespace UnityEngine.Headless
{
    /// A preview scene as in the editor, which is not played, with the objects that `build` creates.
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
