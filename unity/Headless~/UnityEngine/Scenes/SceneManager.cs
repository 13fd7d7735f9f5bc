using UnityEngine.Events;

namespace UnityEngine.Events
{
    public delegate void UnityAction();
    public delegate void UnityAction<T0>(T0 arg0);
    public delegate void UnityAction<T0, T1>(T0 arg0, T1 arg1);
}

namespace UnityEngine.SceneManagement
{
    public enum LoadSceneMode
    {
        Single = 0,
        Additive,
    }

    public class SceneManager
    {
        public static event UnityAction<Scene, LoadSceneMode> sceneLoaded;
        public static event UnityAction<Scene> sceneUnloaded;

        public static int sceneCount => Scene.Loaded.Count;
        public static Scene GetActiveScene() => Scene.Active;
        public static Scene GetSceneAt(int index) => Scene.Loaded[index];

        internal static void RaiseLoaded(Scene scene, LoadSceneMode mode) => Headless.Loop.InvokeAll(() => sceneLoaded?.Invoke(scene, mode));
        internal static void RaiseUnloaded(Scene scene) => Headless.Loop.InvokeAll(() => sceneUnloaded?.Invoke(scene));

        internal static void ResetState()
        {
            sceneLoaded = null;
            sceneUnloaded = null;
            Scene.ResetState();
        }
    }
}
