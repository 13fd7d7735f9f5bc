using UnityEditor;

namespace Collektive.Unity.Editor
{
    /// <summary>One user's Collektive settings for this project. The file <c>UserSettings/Collektive.asset</c> stores them and is not committed.</summary>
    [FilePath("UserSettings/Collektive.asset", FilePathAttribute.Location.ProjectFolder)]
    internal sealed class PersonalSettings : ScriptableSingleton<PersonalSettings>
    {
        /// <summary>Root of a JDK 17 or newer, for building programs; empty to search for one.</summary>
        public string jdk = "";

        /// <summary>Root of a Kotlin compiler (the folder kotlinc); empty to search for one.</summary>
        public string kotlin = "";

        /// <summary>Root of a source checkout of the package; empty for most projects.</summary>
        public string sourceCheckout = "";

        internal void Store() => Save(true);

        /// <summary>Moves paths that earlier versions stored in the project settings to the personal settings.</summary>
        [InitializeOnLoadMethod]
        private static void MigratePaths()
        {
            var old = ProjectSettings.instance;
            if (old.jdk.Length + old.kotlin.Length + old.sourceCheckout.Length == 0) return;
            var own = instance;
            if (own.jdk.Length == 0) own.jdk = old.jdk;
            if (own.kotlin.Length == 0) own.kotlin = old.kotlin;
            if (own.sourceCheckout.Length == 0) own.sourceCheckout = old.sourceCheckout;
            own.Store();
            old.jdk = old.kotlin = old.sourceCheckout = "";
            old.Store();
        }
    }
}
