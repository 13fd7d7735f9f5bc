using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    public sealed class CreateMenuTests : ProjectFixture
    {
        [TestCase("Node")]
        [TestCase("Simulation Manager")]
        public void Objects_created_from_the_menu_can_be_undone(string name)
        {
            Project.Undoable.Clear();
            EditorApplication.ExecuteMenuItem("GameObject/Collektive/" + name);
            Assert.That(Project.Undoable, Is.EqualTo(new[] { "Create " + name }));
        }

        [Test]
        public void The_tutorial_opens_from_the_menu()
        {
            EditorApplication.ExecuteMenuItem("Tools/Collektive/Tutorial");
            Assert.That(Loop.OpenedUrl, Is.StringEnding("/Documentation~/first-swarm-in-unity.md"));
            Assert.That(System.IO.File.Exists(System.IO.Path.Combine(Root, "Documentation~/first-swarm-in-unity.md")), Is.True);
        }
    }
}
