using System.Collections;
using System.Text.RegularExpressions;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Collektive.Unity.Tests
{
    /// <summary>Tests managers and nodes in a scene without programs, which needs no JVM.</summary>
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
        public IEnumerator A_missing_schema_stops_the_simulation_with_an_error()
        {
            LogAssert.Expect(LogType.Error, new Regex("Simulation stopped: schema 'nowhere.NoSchema' does not exist.*Select one in the Simulation Manager"));
            var manager = Create<SimulationManager>("Manager");
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
            var first = Create<SimulationManager>("First");
            LogAssert.Expect(LogType.Error, new Regex("'Second' is a second Simulation Manager; 'First' already runs the simulation"));
            var second = Create<SimulationManager>("Second");
            Assert.That(first.enabled, Is.True);
            Assert.That(second.enabled, Is.False);
            Assert.That(SimulationManager.Current, Is.EqualTo(first));
        }

        [Test]
        public void Nodes_join_in_any_order_and_leave_when_they_are_disabled()
        {
            var early = Create<Node>("Early");
            var manager = Create<SimulationManager>("Manager");
            var late = Create<Node>("Late");
            Assert.That(manager.Nodes, Is.EqualTo(new[] { early, late }));
            Assert.That(late.Id, Is.EqualTo(1));
            early.enabled = false;
            Assert.That(manager.Nodes, Is.EqualTo(new[] { late }));
            Assert.That(early.Id, Is.EqualTo(-1));
        }

        [Test]
        public void Two_nodes_with_one_id_stop_the_simulation()
        {
            var manager = Create<SimulationManager>("Manager");
            Create<Node>("One");
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
            Assert.That(Create<Thermometer>("Alone").enabled, Is.False);
        }

        [Test]
        public void A_scene_builder_without_a_manager_logs_an_error()
        {
            LogAssert.Expect(LogType.Error, new Regex("EmptyScene on 'Builder' needs a Simulation Manager"));
            Create<EmptyScene>("Builder");
        }

        [Test]
        public void An_enabled_manager_switches_physics_to_script_mode()
        {
            var before = Physics.simulationMode;
            var manager = Create<SimulationManager>("Manager");
            Assert.That(Physics.simulationMode, Is.EqualTo(SimulationMode.Script));
            manager.enabled = false;
            Assert.That(Physics.simulationMode, Is.EqualTo(before));
        }

        private T Create<T>(string name) where T : Component
        {
            var gameObject = new GameObject(name);
            gameObject.transform.SetParent(root.transform);
            return gameObject.AddComponent<T>();
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
