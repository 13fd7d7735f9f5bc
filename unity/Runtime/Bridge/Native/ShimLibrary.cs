using System;
using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>Whether the native library can be used in this process.</summary>
    internal static class ShimLibrary
    {
        /// <summary>
        /// The library's error with the platform and the fix, or null if the library is usable. It is determined once, because a process that failed to
        /// load a library cannot load it later.
        /// </summary>
        internal static readonly string Problem = FindProblem();

        /// <exception cref="BridgeException">The library cannot be used.</exception>
        internal static void Check()
        {
            if (Problem != null) throw new BridgeException(BridgeError.Host, Problem);
        }

#if UNITY_5_3_OR_NEWER && !UNITY_EDITOR && !UNITY_STANDALONE
        private static string FindProblem() => Missing("this platform does not support a JVM inside the process");
#else
        private static string FindProblem()
        {
            try
            {
                var major = Shim.clk_version() >> 16;
                if (major == Shim.Major) return null;
                return "the native library collektive_shim has version " + major + ", but this package needs version " + Shim.Major
                    + ": reinstall the package and restart the editor";
            }
            catch (Exception error) when (error is DllNotFoundException || error is EntryPointNotFoundException || error is BadImageFormatException)
            {
                return Missing(error.Message);
            }
        }
#endif

        private static string Missing(string reason) =>
            "the native library collektive_shim is not available for this platform, " + OperatingSystem() + " on " + RuntimeInformation.ProcessArchitecture
                + " (" + reason + "): reinstall the package and restart. If the error remains, the platform is not supported "
                + "(see Limits in the documentation)";

        /// <summary>Returns the operating system's name. Mono describes every system except Windows as Unix.</summary>
        private static string OperatingSystem() =>
            RuntimeInformation.IsOSPlatform(OSPlatform.Linux) ? "Linux"
                : RuntimeInformation.IsOSPlatform(OSPlatform.OSX) ? "macOS"
                : RuntimeInformation.IsOSPlatform(OSPlatform.Windows) ? "Windows" : RuntimeInformation.OSDescription;
    }
}
