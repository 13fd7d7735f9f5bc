using System;
using System.IO;
using System.Linq;
using System.Reflection;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

namespace Collektive.Headless.Tests.Editor
{
    /// <summary>
    /// Tests that the prefabs in the scenes of samples equal the objects that runs without Unity build, because these runs cannot read prefabs.
    /// </summary>
    public sealed class SamplePrefabTests : ProjectFixture
    {
        private const string Folder = "Packages/org.collektive.unity/Samples~/GradientAscent/";

        [Test]
        public void The_prefab_of_Gradient_Ascent_has_the_parts_of_the_built_object()
        {
            var samples = Assembly.LoadFrom(Path.Combine(AppDomain.CurrentDomain.BaseDirectory, "Collektive.Samples.dll"));
            var scene = samples.GetType("CollektiveSamples.GradientAscent.GradientAscentScene", true);
            var built = (GameObject)scene.GetMethod("MakeOriginal", BindingFlags.Static | BindingFlags.NonPublic).Invoke(null, null);
            var prefab = AssetDatabase.LoadAssetAtPath<GameObject>(Folder + "Climber.prefab");
            // In the prefab, a child has the renderer.
            Assert.That(Names(prefab), Is.EqualTo(Names(built).Except(new[] { "MeshFilter", "MeshRenderer" })));
            var text = File.ReadAllText(Path.Combine(Root, "unity/Samples~/GradientAscent/Climber.prefab"));
            Assert.That(text, Is.StringContaining("m_Constraints: " + (int)built.GetComponent<Rigidbody>().constraints + "\n"));
            Assert.That(text, Is.StringContaining("m_Mass: " + built.GetComponent<Rigidbody>().mass + "\n"));
        }

        private static string[] Names(GameObject owner) => owner.GetComponents<Component>().Select(each => each.GetType().Name).OrderBy(name => name).ToArray();
    }
}
