using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>The Collektive settings that all users of the project share, stored in <c>ProjectSettings/Collektive.asset</c>.</summary>
    [FilePath("ProjectSettings/Collektive.asset", FilePathAttribute.Location.ProjectFolder)]
    internal sealed class ProjectSettings : ScriptableSingleton<ProjectSettings>
    {
        /// <summary>Whether Play starts with the previous programs after a failed build.</summary>
        public WhenProgramsFail whenProgramsFail = WhenProgramsFail.Ask;

        /// <summary>Whether a running simulation continues with programs that are saved and built while it runs.</summary>
        public bool reloadWhilePlaying = true;

        /// <summary>Field of versions up to 0.2, replaced by <see cref="PersonalSettings"/>.</summary>
        [HideInInspector]
        public string jdk = "";

        /// <summary>Field of versions up to 0.2, replaced by <see cref="PersonalSettings"/>.</summary>
        [HideInInspector]
        public string kotlin = "";

        /// <summary>Field of versions up to 0.2, replaced by <see cref="PersonalSettings"/>.</summary>
        [HideInInspector]
        public string sourceCheckout = "";

        internal void Store() => Save(true);
    }
}
