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
        internal static string ActiveName = "Scene";

        public static event UnityAction<Scene, LoadSceneMode> sceneLoaded;
        public static event UnityAction<Scene> sceneUnloaded;

        public static int sceneCount => 1;
        public static Scene GetActiveScene() => Scene.Active;
        public static Scene GetSceneAt(int index) => Scene.Active;

        internal static void RaiseLoaded() => sceneLoaded?.Invoke(Scene.Active, LoadSceneMode.Single);
        internal static void RaiseUnloaded() => sceneUnloaded?.Invoke(Scene.Active);

        internal static void ResetState()
        {
            sceneLoaded = null;
            sceneUnloaded = null;
            ActiveName = "Scene";
        }
    }
}
