using System.Collections.Generic;

namespace UnityEngine.SceneManagement
{
    /// The headless player has one scene; the editor also opens previews of others.
    public struct Scene
    {
        internal static readonly List<GameObject> Roots = new List<GameObject>();

        internal static Scene Active => new Scene { roots = Roots };

        List<GameObject> roots;

        internal static Scene Preview(List<GameObject> roots) => new Scene { roots = roots };

        bool IsActive => roots == Roots;

        public bool IsValid() => roots != null;
        public string path => "";
        public string name { get => IsActive ? SceneManager.ActiveName : ""; set => SceneManager.ActiveName = value; }
        public bool isLoaded => roots != null;
        public int buildIndex => IsActive ? 0 : -1;
        public int rootCount => roots == null ? 0 : roots.Count;
        public GameObject[] GetRootGameObjects() => roots == null ? new GameObject[0] : roots.ToArray();

        public void GetRootGameObjects(List<GameObject> rootGameObjects)
        {
            rootGameObjects.Clear();
            if (roots != null) rootGameObjects.AddRange(roots);
        }

        public static bool operator ==(Scene lhs, Scene rhs) => lhs.roots == rhs.roots;
        public static bool operator !=(Scene lhs, Scene rhs) => !(lhs == rhs);
        public override bool Equals(object other) => other is Scene scene && this == scene;
        public override int GetHashCode() => roots == null ? 0 : roots.GetHashCode();
    }
}
