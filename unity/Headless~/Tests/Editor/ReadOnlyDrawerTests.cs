using Collektive.Unity;
using NUnit.Framework;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Editor
{
    public sealed class ReadOnlyDrawerTests
    {
        private sealed class Holder : ScriptableObject
        {
            [InspectorReadOnly]
            public string text = "seen";
        }

        [Test]
        public void A_list_is_read_only_as_a_whole() => Assert.That(new InspectorReadOnlyAttribute().applyToCollection, Is.True);

        [Test]
        public void The_field_is_drawn_but_disabled()
        {
            Gui.Clear();
            var property = new SerializedObject(ScriptableObject.CreateInstance<Holder>()).FindProperty("text");
            Gui.Passes(() => Menus.DrawerOf(typeof(InspectorReadOnlyAttribute)).OnGUI(default, property, GUIContent.none));
            Assert.That(Gui.Lines, Is.EqualTo(new[] { "(disabled) property text" }));
            Assert.That(Gui.DisabledDepth, Is.EqualTo(0));
        }
    }
}
