using System;
using System.Collections.Generic;
using System.Reflection;
using Collektive.Headless.Tests.Simulation;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Components
{
    /// <summary>Tests the menu entries, tooltips and gizmos of the ready-made components.</summary>
    [TestFixture]
    public sealed class ReadyPartsTests
    {
        [SetUp]
        public void MakeNoScene()
        {
            Loop.Reset();
            DrawLog.Gizmos.Clear();
        }

        [TearDown]
        public void RemoveScene() => Loop.Reset();

        [Test]
        public void Every_public_component_is_in_the_Collektive_menu()
        {
            foreach (var type in typeof(Node).Assembly.GetTypes())
            {
                if (!type.IsPublic || type.IsAbstract || !typeof(MonoBehaviour).IsAssignableFrom(type)) continue;
                var menu = type.GetCustomAttribute<AddComponentMenu>();
                Assert.That(menu == null ? "" : menu.componentMenu, Is.StringStarting("Collektive/"), type.Name);
            }
        }

        [Test]
        public void Every_serialised_field_has_a_tooltip()
        {
            foreach (var type in typeof(Node).Assembly.GetTypes())
            {
                var isObject = typeof(MonoBehaviour).IsAssignableFrom(type) || typeof(ScriptableObject).IsAssignableFrom(type);
                if (!isObject && !type.IsSerializable || type.IsEnum || typeof(Delegate).IsAssignableFrom(type)) continue;
                foreach (var field in type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly))
                {
                    if (!field.IsPublic && field.GetCustomAttribute<SerializeField>() == null) continue;
                    if (field.GetCustomAttribute<HideInInspector>() != null) continue;
                    Assert.That(field.GetCustomAttribute<TooltipAttribute>(), Is.Not.Null, type.Name + "." + field.Name);
                }
            }
        }

        [TestCase(typeof(SimulationManager))]
        [TestCase(typeof(Node))]
        [TestCase(typeof(LinkView))]
        public void A_GameObject_can_have_only_one_of_each(Type type)
        {
            Assert.That(type.GetCustomAttribute<DisallowMultipleComponent>(), Is.Not.Null);
        }

        [TestCase(typeof(RadiusNeighbourhood), "sphere (1.00, 2.00, 3.00) 3")]
        [TestCase(typeof(LineOfSightNeighbourhood), "sphere (1.00, 2.00, 3.00) 3")]
        [TestCase(typeof(IntensitySource), "sphere (1.00, 2.00, 3.00) 100")]
        [TestCase(typeof(SpeedTests.Near), "sphere (1.00, 2.00, 3.00) 1")]
        public void A_selected_component_draws_its_range_as_a_sphere(Type type, string sphere)
        {
            Select(type);
            Assert.That(DrawLog.Gizmos, Is.EqualTo(new[] { sphere }));
        }

        [Test]
        public void A_selected_ray_fan_draws_each_ray()
        {
            Select(typeof(SpeedTests.Far));
            Assert.That(DrawLog.Gizmos.Count, Is.EqualTo(8));
            Assert.That(DrawLog.Gizmos[0], Is.EqualTo("ray (1.00, 2.00, 3.00) (0.00, 0.00, 5.00)"));
            Assert.That(DrawLog.Gizmos[2], Is.EqualTo("ray (1.00, 2.00, 3.00) (5.00, 0.00, 0.00)"));
        }

        [Test]
        public void A_selected_explicit_rule_draws_lines_to_existing_neighbours()
        {
            var other = new GameObject("Other").AddComponent<Node>();
            Select(typeof(ExplicitNeighbourhood), part => ((ExplicitNeighbourhood)part).Neighbours.AddRange(new List<Node> { other, null }));
            Assert.That(DrawLog.Gizmos, Is.EqualTo(new[] { "line (1.00, 2.00, 3.00) (0.00, 0.00, 0.00)" }));
        }

        /// <summary>Sends a component the message that the editor sends to a selected object.</summary>
        private static void Select(Type type, Action<Component> prepare = null)
        {
            var holder = new GameObject("Selected");
            holder.transform.position = new Vector3(1, 2, 3);
            var part = holder.AddComponent(type);
            prepare?.Invoke(part);
            MethodInfo message = null;
            for (var at = type; message == null && at != null; at = at.BaseType)
            {
                message = at.GetMethod("OnDrawGizmosSelected", BindingFlags.Instance | BindingFlags.NonPublic | BindingFlags.DeclaredOnly);
            }
            Assert.That(message, Is.Not.Null, type.Name + " draws nothing");
            message.Invoke(part, null);
        }
    }
}
