using System.Text.RegularExpressions;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;
using UnityEngine.TestTools;

namespace Collektive.Unity.Editor.Tests
{
    public sealed class CreateMenuTests
    {
        [TearDown]
        public void RemoveCreatedObjects()
        {
            foreach (var name in new[] { "Simulation Manager", "Node", "Parent" })
            {
                for (var created = GameObject.Find(name); created != null; created = GameObject.Find(name)) Object.DestroyImmediate(created);
            }
            Selection.activeGameObject = null;
        }

        [Test]
        public void The_menu_creates_a_manager_and_selects_it()
        {
            Assert.That(EditorApplication.ExecuteMenuItem("GameObject/Collektive/Simulation Manager"), Is.True);
            var created = GameObject.Find("Simulation Manager");
            Assert.That(created != null && created.GetComponent<SimulationManager>() != null, Is.True);
            Assert.That(Selection.activeGameObject, Is.EqualTo(created));
        }

        [Test]
        public void The_menu_does_not_create_a_second_manager()
        {
            EditorApplication.ExecuteMenuItem("GameObject/Collektive/Simulation Manager");
            LogAssert.Expect(LogType.Warning, new Regex("already has a Simulation Manager"));
            EditorApplication.ExecuteMenuItem("GameObject/Collektive/Simulation Manager");
            Assert.That(RemoveManagers(), Is.EqualTo(1));
        }

        [Test]
        public void A_created_node_has_a_body_and_a_radius_neighbourhood()
        {
            EditorApplication.ExecuteMenuItem("GameObject/Collektive/Node");
            var created = GameObject.Find("Node");
            Assert.That(created.GetComponent<Node>() != null, Is.True);
            Assert.That(created.GetComponent<RadiusNeighbourhood>() != null, Is.True);
            Assert.That(created.GetComponent<Rigidbody>() != null, Is.True);
            Assert.That(created.GetComponent<SphereCollider>() != null, Is.True);
            Assert.That(created.GetComponentInChildren<MeshRenderer>().GetComponent<SmoothView>() != null, Is.True);
            Assert.That(created.transform.localScale, Is.EqualTo(new Vector3(0.5f, 0.5f, 0.5f)));
        }

        [Test]
        public void A_node_is_created_below_the_clicked_object_in_its_own_size()
        {
            var parent = new GameObject("Parent");
            CreateMenu.CreateNode(new MenuCommand(parent));
            Assert.That(parent.transform.childCount, Is.EqualTo(1));
            var node = parent.transform.GetChild(0);
            Assert.That(node.name, Is.EqualTo("Node"));
            Assert.That(node.localPosition, Is.EqualTo(Vector3.zero));
            Assert.That(node.localScale, Is.EqualTo(new Vector3(0.5f, 0.5f, 0.5f)));
        }

        [Test]
        public void Two_clicks_do_not_nest_nodes()
        {
            EditorApplication.ExecuteMenuItem("GameObject/Collektive/Node");
            var first = Selection.activeGameObject;
            EditorApplication.ExecuteMenuItem("GameObject/Collektive/Node");
            Assert.That(first.GetComponentsInChildren<Node>().Length, Is.EqualTo(1));
            Assert.That(Selection.activeGameObject.transform.parent == null, Is.True);
            Object.DestroyImmediate(Selection.activeGameObject);
        }

        [Test]
        public void An_asset_does_not_become_the_parent()
        {
            var prefab = AssetDatabase.LoadAssetAtPath<GameObject>(AssetDatabase.GUIDToAssetPath(CreateMenu.NodePrefab));
            CreateMenu.CreateNode(new MenuCommand(prefab));
            Assert.That(Selection.activeGameObject.transform.parent == null, Is.True);
            Object.DestroyImmediate(Selection.activeGameObject);
        }

        [Test]
        public void Created_siblings_have_different_names()
        {
            var parent = new GameObject("Parent");
            for (var i = 0; i < 2; i++) CreateMenu.CreateNode(new MenuCommand(parent));
            Assert.That(parent.transform.GetChild(0).name, Is.Not.EqualTo(parent.transform.GetChild(1).name));
        }

        private static int RemoveManagers()
        {
            var count = 0;
            for (var created = GameObject.Find("Simulation Manager"); created != null; created = GameObject.Find("Simulation Manager"))
            {
                count++;
                Object.DestroyImmediate(created);
            }
            return count;
        }
    }
}
