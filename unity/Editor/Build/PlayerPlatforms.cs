using System.IO;
using UnityEditor;

namespace Collektive.Unity.Editor
{
    /// <summary>Finds the platforms that a player supports, with the package's names for platforms.</summary>
    internal static class PlayerPlatforms
    {
        /// <summary>Finds the platforms on which a build for a target runs, depending on the architecture in the build settings.</summary>
        /// <returns>The reason why simulations cannot run on the target, or null.</returns>
        internal static string Find(BuildTarget target, out string[] platforms)
        {
            var architecture = EditorUserBuildSettings.GetPlatformSettings(BuildPipeline.GetBuildTargetName(target), "Architecture").ToLowerInvariant();
            platforms = Of(target, architecture);
            if (platforms == null)
                return "Collektive does not support " + target + (architecture.Length > 0 ? " on " + architecture : "")
                    + ": select Windows or Linux on x64, Linux on ARM64 or macOS in the build settings, or remove the Simulation Manager from the scene";
            // The package has no library for Linux on ARM64, because Unity before 6000.5 would overwrite the x64 library with it.
            if (platforms[0] == "linux-arm64" && !File.Exists(Installation.ToPhysical("Packages/org.collektive.unity.jvm.linux-arm64/package.json")))
                return "players for Linux on ARM64 need the native library in org.collektive.unity.jvm.linux-arm64, for Unity 6000.5 or newer: "
                    + "install this package";
            return null;
        }

        /// <returns>The names of the platforms, or null for an unsupported target.</returns>
        private static string[] Of(BuildTarget target, string architecture)
        {
            switch (target)
            {
                case BuildTarget.StandaloneWindows64 when architecture != "arm64": return new[] { "win-x64" };
                case BuildTarget.StandaloneOSX when architecture == "arm64": return new[] { "mac-arm64" };
                case BuildTarget.StandaloneOSX when architecture == "x64": return new[] { "mac-x64" };
                case BuildTarget.StandaloneOSX: return new[] { "mac-arm64", "mac-x64" };
                case BuildTarget.StandaloneLinux64 when architecture == "arm64": return new[] { "linux-arm64" };
                case BuildTarget.StandaloneLinux64: return new[] { "linux-x64" };
                default: return null;
            }
        }
    }
}
