using System.Collections.Generic;

namespace UnityEngine.SceneManagement
{
    /// A loaded scene, or a preview scene of the editor.
    public struct Scene
    {
        /// The loaded scenes. The first is the player's scene.
        internal static readonly List<Scene> Loaded = new List<Scene> { new Scene("Scene") };

        internal static Scene Active = Loaded[0];

        readonly Content content;

        internal Scene(string name) => content = new Content { Name = name };

        internal sealed class Content
        {
            internal readonly List<GameObject> Roots = new List<GameObject>();
            internal string Name;
            internal string Path = "";
            internal bool IsUnloaded;
        }

        internal List<GameObject> Roots => content.Roots;
        internal string File { set => content.Path = value; }

        /// Whether the scene is only listed in the Hierarchy window.
        internal bool IsUnloaded { set => content.IsUnloaded = value; }

        public bool IsValid() => content != null;
        public string path => content == null ? "" : content.Path;
        public string name { get => content == null ? "" : content.Name; set => content.Name = value; }
        public bool isLoaded => Loaded.Contains(this) && !content.IsUnloaded;
        public int buildIndex => Loaded.IndexOf(this);
        public int rootCount => content == null ? 0 : Roots.Count;

        public GameObject[] GetRootGameObjects()
        {
            ThrowIfInvalid();
            if (content.IsUnloaded) throw new System.ArgumentException("The scene is not loaded.");
            return Roots.ToArray();
        }

        public void GetRootGameObjects(List<GameObject> rootGameObjects)
        {
            rootGameObjects.Clear();
            ThrowIfInvalid();
            rootGameObjects.AddRange(Roots);
        }

        void ThrowIfInvalid()
        {
            if (content == null) throw new System.ArgumentException("The scene is invalid.");
        }

        internal static IEnumerable<GameObject> AllRoots()
        {
            foreach (var scene in Loaded)
                foreach (var root in scene.Roots.ToArray()) yield return root;
        }

        internal static void ResetState()
        {
            Loaded.RemoveRange(1, Loaded.Count - 1);
            Active = Loaded[0];
            Active.name = "Scene";
            Active.File = "";
        }

        public static bool operator ==(Scene lhs, Scene rhs) => lhs.content == rhs.content;
        public static bool operator !=(Scene lhs, Scene rhs) => !(lhs == rhs);
        public override bool Equals(object other) => other is Scene scene && this == scene;
        public override int GetHashCode() => content == null ? 0 : content.GetHashCode();
    }
}
