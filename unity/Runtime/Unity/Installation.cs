using System;
using System.IO;

namespace Collektive.Unity
{
    /// <summary>Where the package's files, the host's jar and the JVM are.</summary>
    public static class Installation
    {
        private const string Package = "Packages/org.collektive.unity";

        private static string hostJar;
        private static string javaHome;

        /// <summary>Path of the host's jar: what was set, else the package's own.</summary>
        public static string HostJar
        {
            get => hostJar ?? PathOf(Package + "/Jvm~/collektive-host.jar");
            set => hostJar = value;
        }

        /// <summary>Root of the JVM: what was set, else the package's bundled one, else <c>JAVA_HOME</c>, else empty.</summary>
        public static string JavaHome
        {
            get
            {
                if (javaHome != null) return javaHome;
                var bundled = PathOf(Package + "/Jvm~/linux-x64");
                return Directory.Exists(bundled) ? bundled : Environment.GetEnvironmentVariable("JAVA_HOME") ?? "";
            }
            set => javaHome = value;
        }

        /// <summary>
        /// The full path of a file named from the project's folder. Names below <c>Packages/org.collektive.unity</c> are the package's own
        /// files, wherever it is installed: a tarball holds its content below <c>unity</c>, a git URL with <c>?path=/unity</c> does not.
        /// </summary>
        public static string PathOf(string file)
        {
            if (!file.StartsWith(Package + "/", StringComparison.Ordinal)) return Path.GetFullPath(file);
            var content = Path.GetFullPath(Package + "/unity");
            return Path.Combine(Directory.Exists(content) ? content : Path.GetFullPath(Package), file.Substring(Package.Length + 1));
        }
    }
}
