using System;
using UnityEngine.SceneManagement;

namespace UnityEngine.Headless
{
    /// A preview scene as in the editor, which is not played. It contains the objects that `build` creates.
    public static class PreviewScene
    {
        public static Scene Open(Action build)
        {
            var first = Scene.Roots.Count;
            build();
            var roots = Scene.Roots.GetRange(first, Scene.Roots.Count - first);
            Scene.Roots.RemoveRange(first, roots.Count);
            return Scene.Preview(roots);
        }

        public static bool Close(Scene scene)
        {
            foreach (var root in scene.GetRootGameObjects()) Object.DestroyImmediate(root);
            return true;
        }
    }
}
