using System;
using System.Collections.Generic;

namespace Collektive.Bridge
{
    /// <summary>The command line of a JVM, built from <see cref="JvmSettings"/> for this machine.</summary>
    internal sealed class JvmLaunch
    {
        /// <summary>Creates the command line for the JRE or JDK at <paramref name="home"/> with the host's jar.</summary>
        public JvmLaunch(string home, string classPath, IReadOnlyList<string> options)
        {
            Home = home ?? throw new ArgumentNullException(nameof(home));
            ClassPath = classPath ?? throw new ArgumentNullException(nameof(classPath));
            Options = options ?? throw new ArgumentNullException(nameof(options));
        }

        /// <summary>Root folder of a JRE or JDK, version 17 or newer.</summary>
        public string Home { get; }

        /// <summary>Path of the host's jar.</summary>
        public string ClassPath { get; }

        /// <summary>The JVM options in order. Each entry is one word of the command line.</summary>
        public IReadOnlyList<string> Options { get; }

        /// <summary>Where the JVM runs.</summary>
        public JvmPlacement Placement { get; set; }

        /// <summary>A warning about a setting that is ignored, with the reason; otherwise empty. The JVM starts anyway.</summary>
        public string Note { get; internal set; } = "";

        /// <summary>Time limit for the whole start in milliseconds.</summary>
        public int StartLimitMs { get; set; } = 30000;
    }
}
