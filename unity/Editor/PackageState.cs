using System.IO;
using UnityEditor;
using UnityEngine;

namespace Collektive.Unity.Editor
{
    /// <summary>Where the package lies, and which version of it this editor began with.</summary>
    internal static class PackageState
    {
        private const string Began = "Collektive.Version";

        /// <summary>The version of the package that is installed.</summary>
        internal static string Version => typeof(SimulationManager).Assembly.GetName().Version.ToString(3);

        /// <summary>After each loading of scripts: an update of the package loads them too, but the native library and the JVM stay what they were.</summary>
        [InitializeOnLoadMethod]
        private static void Look()
        {
            Installation.ToPhysical = path => Path.GetFullPath(FileUtil.GetPhysicalPath(path));
            var began = SessionState.GetString(Began, "");
            if (began.Length == 0) SessionState.SetString(Began, Version);
            else if (began != Version) Debug.LogWarning("Collektive was updated from " + began + " to " + Version
                + ": restart the editor, whose native library and JVM are still those of " + began);
        }
    }
}
