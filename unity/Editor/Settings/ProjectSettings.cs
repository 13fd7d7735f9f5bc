using UnityEditor;

namespace Collektive.Unity.Editor
{
    /// <summary>The project's Collektive settings, shared with the project's other users: <c>ProjectSettings/Collektive.asset</c>.</summary>
    [FilePath("ProjectSettings/Collektive.asset", FilePathAttribute.Location.ProjectFolder)]
    internal sealed class ProjectSettings : ScriptableSingleton<ProjectSettings>
    {
        /// <summary>Root of a JDK 17 or newer, for building programs; empty to look for one.</summary>
        public string jdk = "";

        /// <summary>Root of a Kotlin compiler (the folder kotlinc); empty to look for one.</summary>
        public string kotlin = "";

        /// <summary>Root of a source checkout of the package; empty for most projects.</summary>
        public string sourceCheckout = "";

        /// <summary>Whether programs whose sources changed are built when Play is pressed.</summary>
        public bool buildBeforePlay = true;

        internal void Store() => Save(true);
    }
}
