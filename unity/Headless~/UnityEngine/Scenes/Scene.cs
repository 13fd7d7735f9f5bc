using System.Collections.Generic;

namespace UnityEngine.SceneManagement
{
    /// The headless player has one scene.
    public struct Scene
    {
        internal static readonly List<GameObject> Roots = new List<GameObject>();

        bool loaded;

        internal static Scene Active => new Scene { loaded = true };

        public bool IsValid() => loaded;
        public string path => "";
        public string name { get => loaded ? SceneManager.ActiveName : ""; set => SceneManager.ActiveName = value; }
        public bool isLoaded => loaded;
        public int buildIndex => loaded ? 0 : -1;
        public int rootCount => loaded ? Roots.Count : 0;
        public GameObject[] GetRootGameObjects() => loaded ? Roots.ToArray() : new GameObject[0];

        public void GetRootGameObjects(List<GameObject> rootGameObjects)
        {
            rootGameObjects.Clear();
            if (loaded) rootGameObjects.AddRange(Roots);
        }

        public static bool operator ==(Scene lhs, Scene rhs) => lhs.loaded == rhs.loaded;
        public static bool operator !=(Scene lhs, Scene rhs) => !(lhs == rhs);
        public override bool Equals(object other) => other is Scene scene && this == scene;
        public override int GetHashCode() => loaded ? 1 : 0;
    }
}
