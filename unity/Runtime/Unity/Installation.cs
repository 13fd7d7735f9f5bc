using System;
using System.IO;

namespace Collektive.Unity
{
    /// <summary>Where the host's jar and the JVM are, for settings that do not say.</summary>
    public static class Installation
    {
        private const string Package = "Packages/org.collektive.unity";

        private static string hostJar;
        private static string javaHome;

        /// <summary>Path of the host's jar: what was set, else the package's own.</summary>
        public static string HostJar
        {
            get => hostJar ?? Path.GetFullPath(Package + "/Jvm~/collektive-host.jar");
            set => hostJar = value;
        }

        /// <summary>Root of the JVM: what was set, else the package's bundled one, else <c>JAVA_HOME</c>, else empty.</summary>
        public static string JavaHome
        {
            get
            {
                if (javaHome != null) return javaHome;
                var bundled = Path.GetFullPath(Package + "/Jvm~/linux-x64");
                return Directory.Exists(bundled) ? bundled : Environment.GetEnvironmentVariable("JAVA_HOME") ?? "";
            }
            set => javaHome = value;
        }
    }
}
