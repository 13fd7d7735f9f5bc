using System;
using System.IO;
using System.Reflection;
using System.Runtime.CompilerServices;
using NUnit.Framework;

namespace Collektive.Unity.PublicApi.Tests
{
    /// <summary>Compares the public API with the lists in the repository.</summary>
    public sealed class PublicApiTests
    {
        private const string Update = "COLLEKTIVE_API_UPDATE";

        [Test]
        public void The_bridge_API_matches_the_checked_in_list() => Compare(typeof(Bridge.Jvm).Assembly);

        [Test]
        public void The_component_API_matches_the_checked_in_list() => Compare(typeof(SimulationManager).Assembly);

        private static void Compare(Assembly assembly)
        {
            var name = assembly.GetName().Name + ".txt";
            var listed = Path.Combine(FolderOfThisFile(), name);
            var actual = PublicApi.Of(assembly);
            var expected = File.Exists(listed) ? File.ReadAllText(listed).Replace("\r\n", "\n") : "";
            if (actual == expected) return;
            if (Environment.GetEnvironmentVariable(Update) == "1")
            {
                File.WriteAllText(listed, actual);
                return;
            }
            Assert.Fail("the public API of " + assembly.GetName().Name + " changed; if this is intended, run: " + Update + "=1 ./collektive test csharp\n" +
                Difference(expected.Split('\n'), actual.Split('\n')));
        }

        private static string Difference(string[] expected, string[] actual)
        {
            var text = "";
            foreach (var line in expected)
            {
                if (Array.IndexOf(actual, line) < 0) text += "- " + line + "\n";
            }
            foreach (var line in actual)
            {
                if (Array.IndexOf(expected, line) < 0) text += "+ " + line + "\n";
            }
            return text;
        }

        private static string FolderOfThisFile([CallerFilePath] string file = "") => Path.GetDirectoryName(Path.GetFullPath(file));
    }
}
