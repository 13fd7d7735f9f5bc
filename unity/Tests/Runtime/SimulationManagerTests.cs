using System.Collections;
using System.Text.RegularExpressions;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Collektive.Unity.Tests
{
    /// <summary>What happens in a scene that has no programs yet: no JVM is needed.</summary>
    public sealed class SimulationManagerTests
    {
        private GameObject root;

        [SetUp]
        public void MakeRoot()
        {
            root = new GameObject("Root");
        }

        [TearDown]
        public void RemoveRoot()
        {
            Object.DestroyImmediate(root);
        }

        [UnityTest]
        public IEnumerator A_scene_without_its_schema_says_what_to_do_and_stops()
        {
            LogAssert.Expect(LogType.Error, new Regex("Simulation stopped: schema 'nowhere.NoSchema' does not exist.*Select one in the Simulation Manager"));
            var manager = Make<SimulationManager>("Manager");
            manager.Settings.jars.Add("programs.jar");
            manager.Settings.schema = "nowhere.NoSchema";
            yield return null;
            yield return null;
            Assert.That(manager.enabled, Is.False);
            Assert.That(manager.Failure, Is.Not.Empty);
            Assert.That(SimulationManager.Current == null, Is.True);
        }

        [Test]
        public void A_second_manager_disables_itself()
        {
            var first = Make<SimulationManager>("First");
            LogAssert.Expect(LogType.Error, new Regex("'Second' is a second Simulation Manager; 'First' already runs the simulation"));
            var second = Make<SimulationManager>("Second");
            Assert.That(first.enabled, Is.True);
            Assert.That(second.enabled, Is.False);
            Assert.That(SimulationManager.Current, Is.EqualTo(first));
        }

        [Test]
        public void Nodes_join_in_any_order_and_leave_when_they_are_disabled()
        {
            var early = Make<Node>("Early");
            var manager = Make<SimulationManager>("Manager");
            var late = Make<Node>("Late");
            Assert.That(manager.Nodes, Is.EqualTo(new[] { early, late }));
            Assert.That(late.Id, Is.EqualTo(1));
            early.enabled = false;
            Assert.That(manager.Nodes, Is.EqualTo(new[] { late }));
            Assert.That(early.Id, Is.EqualTo(-1));
        }

        [Test]
        public void Two_nodes_with_one_id_stop_the_simulation()
        {
            var manager = Make<SimulationManager>("Manager");
            Make<Node>("One");
            var holder = new GameObject("Other");
            holder.transform.SetParent(root.transform);
            holder.SetActive(false);
            holder.AddComponent<Node>().RequestedId = 0;
            LogAssert.Expect(LogType.Error, new Regex("'Other' has id 0, which node 'One' already uses"));
            holder.SetActive(true);
            Assert.That(manager.enabled, Is.False);
        }

        [Test]
        public void A_sensor_without_a_node_is_disabled()
        {
            LogAssert.Expect(LogType.Error, new Regex("Thermometer on 'Alone' has no Node"));
            Assert.That(Make<Thermometer>("Alone").enabled, Is.False);
        }

        [Test]
        public void A_scene_builder_without_a_manager_says_so()
        {
            LogAssert.Expect(LogType.Error, new Regex("EmptyScene on 'Builder' needs a Simulation Manager"));
            Make<EmptyScene>("Builder");
        }

        [Test]
        public void Physics_are_the_managers_while_it_is_enabled()
        {
            var before = Physics.simulationMode;
            var manager = Make<SimulationManager>("Manager");
            Assert.That(Physics.simulationMode, Is.EqualTo(SimulationMode.Script));
            manager.enabled = false;
            Assert.That(Physics.simulationMode, Is.EqualTo(before));
        }

        private T Make<T>(string name) where T : Component
        {
            var made = new GameObject(name);
            made.transform.SetParent(root.transform);
            return made.AddComponent<T>();
        }

        private sealed class Thermometer : Sensor<float>
        {
            protected override void Sense(ref float data) => data = 20;
        }

        private sealed class EmptyScene : SceneBuilder
        {
            protected override void Build(SimulationManager manager)
            {
            }
        }
    }
}
