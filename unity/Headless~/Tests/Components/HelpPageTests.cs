using System;
using System.IO;
using System.Reflection;
using System.Text.RegularExpressions;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Collektive.Headless.Tests.Components
{
    /// <summary>Tests the pages that the help buttons of components and assets open.</summary>
    public sealed class HelpPageTests
    {
        private static string Manual => Path.Combine(Environment.GetEnvironmentVariable("COLLEKTIVE_ROOT"), "Documentation~");

        [Test]
        public void Each_component_and_asset_has_an_existing_page_and_section()
        {
            foreach (var type in typeof(SimulationManager).Assembly.GetExportedTypes())
            {
                if (!typeof(Object).IsAssignableFrom(type)) continue;
                var help = type.GetCustomAttribute<HelpPageAttribute>(true);
                Assert.That(help, Is.Not.Null, type + " has no page");
                var parts = help.Page.Split('#');
                Assert.That(File.Exists(Path.Combine(Manual, parts[0])), Is.True, type + ": the page " + parts[0] + " does not exist");
                if (parts.Length > 1) Assert.That(Anchors(parts[0]), Has.Some.EqualTo(parts[1]), type.ToString());
            }
        }

        [Test]
        public void Components_of_users_inherit_the_page() =>
            Assert.That(typeof(UsersSensor).GetCustomAttribute<HelpURLAttribute>(true).URL, Is.StringEnding("/sensors-and-actuators.md#ready-made-components"));

        [Test]
        public void A_release_opens_its_repository_and_a_clone_its_own_file()
        {
            var folder = Path.Combine(Path.GetTempPath(), "collektive-help-" + Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(folder);
            var before = Installation.ToPhysical;
            Installation.ToPhysical = path => Path.Combine(folder, path.Replace("Packages/org.collektive.unity/", ""));
            var clone = Installation.ToPhysical;
            try
            {
                var help = typeof(JvmSettingsAsset).GetCustomAttribute<HelpURLAttribute>();
                Assert.That(help.URL, Is.EqualTo("file://" + folder + "/Documentation~/jvm-and-jfr.md#settings"));
                File.WriteAllText(Path.Combine(folder, "package.json"), "{ \"documentationUrl\": \"https://example.org/blob/v1/Documentation~/index.md\" }");
                Installation.ToPhysical = clone;
                Assert.That(help.URL, Is.EqualTo("https://example.org/blob/v1/Documentation~/jvm-and-jfr.md#settings"));
            }
            finally
            {
                Installation.ToPhysical = before;
                Directory.Delete(folder, true);
            }
        }

        /// <summary>Returns the anchors of a page's headings, as GitHub and the site generate them.</summary>
        private static string[] Anchors(string page)
        {
            var headings = Array.FindAll(File.ReadAllLines(Path.Combine(Manual, page)), line => line.StartsWith("#"));
            return Array.ConvertAll(headings, line => Regex.Replace(line.TrimStart('#').Trim().ToLowerInvariant(), "[^a-z0-9 -]", "").Replace(' ', '-'));
        }

        private sealed class UsersSensor : Sensor<float>
        {
            protected override void Sense(ref float data)
            {
            }
        }
    }
}
