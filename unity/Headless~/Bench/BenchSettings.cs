using System;
using System.Collections.Generic;
using System.Globalization;

namespace Collektive.Headless.Bench
{
    /// <summary>The command line; <c>./collektive bench tick</c> writes it.</summary>
    internal sealed class BenchSettings
    {
        internal const string Usage =
            "Bench --java-home DIR --host-jar JAR --jar JAR [--jar JAR]... --out FILE [--quick] [--nodes N,N...]";

        /// <summary>
        /// Options of both JVMs: the package's defaults, and a heap of fixed size that is in memory from the start.
        /// </summary>
        internal static readonly string[] JvmOptions =
            { "-Xms768m", "-Xmx768m", "-XX:+AlwaysPreTouch", "-XX:+UseSerialGC", "-XX:MaxTenuringThreshold=2", "-XX:+UseCondCardMark" };

        internal string JavaHome { get; private set; }

        internal string HostJar { get; private set; }

        /// <summary>The library with which the second process runs rounds without a session.</summary>
        internal string LibraryJar => System.IO.Path.Combine(System.IO.Path.GetDirectoryName(HostJar), "collektive-library.jar");

        internal List<string> Jars { get; } = new List<string>();

        internal string Out { get; private set; }

        internal bool Quick { get; private set; }

        internal int[] Nodes { get; private set; } = { 12, 100, 500, 1000, 5000, 10000, 50000 };

        internal static BenchSettings Parse(string[] arguments)
        {
            var settings = new BenchSettings();
            for (var i = 0; i < arguments.Length; i++)
            {
                if (arguments[i] == "--quick")
                {
                    settings.Quick = true;
                    continue;
                }
                if (i + 1 == arguments.Length) throw new BenchException(arguments[i] + " needs a value\nusage: " + Usage);
                settings.Set(arguments[i], arguments[++i]);
            }
            if (settings.JavaHome == null || settings.HostJar == null || settings.Jars.Count == 0 || settings.Out == null)
                throw new BenchException("usage: " + Usage);
            return settings;
        }

        private void Set(string name, string value)
        {
            switch (name)
            {
                case "--java-home": JavaHome = value; break;
                case "--host-jar": HostJar = value; break;
                case "--jar": Jars.Add(value); break;
                case "--out": Out = value; break;
                case "--nodes": Nodes = Array.ConvertAll(value.Split(','), Count); break;
                default: throw new BenchException("unknown option " + name + "\nusage: " + Usage);
            }
        }

        private static int Count(string text)
        {
            if (int.TryParse(text, NumberStyles.None, CultureInfo.InvariantCulture, out var count) && count > 0 && count <= 1000000) return count;
            throw new BenchException("--nodes " + text + ": use numbers from 1 to 1000000, separated by commas");
        }
    }
}
