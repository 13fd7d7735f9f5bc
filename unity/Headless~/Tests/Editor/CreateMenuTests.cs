using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;

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
    }
}
