using System;
using System.Collections.Generic;
using System.Linq;
using Collektive.Bridge;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEditor.Headless;
using UnityEngine;
using UnityEngine.Headless;
using Object = UnityEngine.Object;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests that each invalid input and each failing program causes one clear error and has no other effect.</summary>
    [TestFixture]
    public sealed class FaultTests : SimulationFixture
    {
        [TestCase(13, "thirteen")]
        [TestCase(15, "StackOverflowError")]
        [TestCase(16, "SecurityException")]
        [TestCase(17, "SecurityException")]
        [TestCase(18, "OutOfMemoryError")]
        [TestCase(19, "view")]
        public void A_failed_round_affects_only_its_node_and_only_this_round(int trouble, string expected)
        {
            Configure("trouble");
            var good = MakeNode(0);
            var bad = MakeNode(0);
            Play(2);
            bad.Sensor.Value = trouble;
            Play(1);
            Assert.That(good.Answer, Is.EqualTo(3));
            Assert.That(bad.Actuator.Calls, Is.EqualTo(2));
            Assert.That(Errors.Count, Is.EqualTo(1));
            Assert.That(Errors[0], Is.StringContaining("node " + bad.Node.Id).And.StringContaining("trouble").And.StringContaining(expected));
            Assert.That(bad.Node.LastError, Is.StringContaining(expected));
            bad.Sensor.Value = 0;
            Play(1);
            Assert.That(bad.Answer, Is.EqualTo(3), "the failed round must not change the state");
            Assert.That(good.Answer, Is.EqualTo(4));
            Assert.That(Manager.Failure, Is.Empty);
        }

        [TestCase(13, "thirteen", "root", "Probe.kt:")]
        [TestCase(21, "two primitives ran at the same path", "clash > share", "Probe.kt:")]
        [TestCase(22, "infinite recursion", "deeper > else > deeper > else", "more)")]
        [TestCase(23, "cannot be combined: one has values for", "misaligned", "Probe.kt:")]
        [TestCase(24, "a float[] cannot be a pivot", "alignedOn", "Probe.kt:")]
        [TestCase(25, "a probe.SensorData inside a kotlin.Pair is a view", "share", "Probe.kt:")]
        [TestCase(26, "a probe.SensorData inside a java.util.", "share", "Probe.kt:")]
        [TestCase(27, "no value for device 99", "when ", "Probe.kt:")]
        public void A_program_error_names_node_path_and_line(int trouble, string what, string path, string line)
        {
            Configure("trouble");
            var good = MakeNode(0);
            var bad = MakeNode(0);
            Manager.AddLink(good.Node.Id, bad.Node.Id);
            Manager.AddLink(bad.Node.Id, good.Node.Id);
            Play(2);
            bad.Sensor.Value = trouble;
            Play(1);
            Assert.That(good.Answer, Is.EqualTo(3));
            var error = bad.Node.LastError;
            Assert.That(error, Is.StringContaining(what).And.StringContaining(line));
            Assert.That(error, Is.StringContaining("[node " + bad.Node.Id + " at ").And.StringContaining(path));
        }

        [Test]
        public void An_endless_round_ends_the_session_and_the_next_session_works()
        {
            Configure("trouble", settings => settings.stepLimitMs = 500);
            var node = MakeNode(14);
            Play(1);
            Assert.That(Manager.Failure, Is.Not.Empty);
            Assert.That(Manager.enabled, Is.False);
            Assert.That(Errors.Count, Is.GreaterThanOrEqualTo(1));
            StopPlaying();
            StartPlaying();
            node = MakeNode(4);
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(8));
        }

        [Test]
        public void A_non_finite_sensor_value_stops_the_simulation_with_node_and_field()
        {
            MakeNode(1);
            var id = MakeNode(float.NaN).Node.Id;
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("node " + id).And.StringContaining("value"));
            Assert.That(Errors.Count, Is.EqualTo(1));
        }

        [Test]
        public void A_duplicate_id_stops_the_simulation_and_names_both_nodes()
        {
            MakeNode(1, default, 5).Node.name = "first";
            var second = new GameObject("second");
            second.SetActive(false);
            second.AddComponent<Node>().RequestedId = 5;
            second.SetActive(true);
            Assert.That(Manager.Failure, Is.StringContaining("id 5").And.StringContaining("first").And.StringContaining("second"));
        }

        [Test]
        public void A_link_to_an_absent_node_logs_one_warning_and_is_ignored()
        {
            var node = MakeNode(1);
            var gone = MakeNode(1);
            Play(1);
            gone.Node.enabled = false;
            Log.Clear();
            for (var i = 0; i < 3; i++)
            {
                Manager.AddLink(node.Node.Id, 1);
                Manager.RemoveLink(1, node.Node.Id);
                Manager.AddLink(node.Node.Id, gone.Node.Id);
            }
            Assert.That(Log.Count, Is.EqualTo(2));
            Assert.That(Log[0], Is.StringContaining("nodes 0 and 1: node 1 is not in the simulation"));
            Assert.That(Log[1], Is.StringContaining("nodes 0 and -1: node -1 is not in the simulation"));
            Play(1);
            Assert.That(Manager.Failure, Is.Empty);
            Assert.That(node.Actuator.Calls, Is.EqualTo(2));
        }

        [Test]
        public void A_link_from_a_node_to_itself_stops_the_simulation()
        {
            var node = MakeNode(1);
            Manager.AddLink(node.Node.Id, node.Node.Id);
            Assert.That(Manager.Failure, Is.StringContaining("itself"));
        }

        [Test]
        public void Programs_that_cannot_be_reloaded_are_reported_and_the_previous_ones_continue()
        {
            Configure("count");
            var node = MakeNode(0);
            Play(2);
            var jars = Manager.Settings.jars;
            Manager.Settings.jars = new List<string> { "missing.jar" };
            Manager.ReloadPrograms();
            Play(1);
            Assert.That(Errors.Single(), Is.StringContaining("programs not reloaded").And.StringContaining("missing.jar"));
            Assert.That(node.Answer, Is.EqualTo(3));
            Manager.Settings.jars = jars;
            Manager.ReloadPrograms();
            Play(1);
            Assert.That(Log, Has.Some.StringContaining("programs reloaded in tick 4: kept 1 of 1 stored values"));
            Assert.That(node.Answer, Is.EqualTo(4));
        }

        [TestCase(true, 1)]
        [TestCase(false, 0)]
        public void Programs_that_were_built_during_play_are_reloaded_if_the_project_allows_it(bool isAllowed, int expected)
        {
            Configure("count");
            MakeNode(0);
            Play(1);
            ProjectSettings.instance.reloadWhilePlaying = isAllowed;
            ProgramBuild.UpdateWhilePlaying(isBuilt: true);
            Play(1);
            ProjectSettings.instance.reloadWhilePlaying = true;
            Assert.That(Log.FindAll(line => line.Contains("programs reloaded")).Count, Is.EqualTo(expected));
        }

        [Test]
        public void A_label_in_the_Game_view_shows_that_a_build_failed_until_one_succeeds()
        {
            Configure("count");
            var node = MakeNode(0);
            Play(1);
            for (var i = 0; i < 2; i++) ProgramBuild.UpdateWhilePlaying(isBuilt: false);
            Play(1);
            var label = Object.FindObjectsByType<BuildFailureLabel>(FindObjectsSortMode.None).Single();
            Gui.Placed.Clear();
            Menus.Send(label, "OnGUI");
            Assert.That(Gui.Placed[0].Text, Is.StringContaining("not compiled; the previous ones continue"));
            Assert.That(node.Answer, Is.EqualTo(2));
            ProgramBuild.UpdateWhilePlaying(isBuilt: true);
            Play(1);
            Assert.That(Object.FindObjectsByType<BuildFailureLabel>(FindObjectsSortMode.None), Is.Empty);
        }

        [Test]
        public void Without_jars_and_libraries_a_simulation_says_what_to_select()
        {
            Configure("double", settings => settings.jars.Clear());
            MakeNode(1);
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("no program library is selected: drag a .clkprograms file to Libraries"));
        }

        [Test]
        public void A_missing_jar_is_reported()
        {
            Configure("double", settings => settings.jars[0] = "nowhere/programs.jar");
            MakeNode(1);
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("programs.jar"));
        }

        [Test]
        public void An_unknown_program_is_reported_with_the_known_programs()
        {
            Configure("nonesuch");
            MakeNode(1);
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("nonesuch").And.StringContaining("double"));
        }

        [Test]
        public void An_unknown_program_of_one_node_is_reported_with_the_node()
        {
            var node = new GameObject("odd");
            node.SetActive(false);
            node.AddComponent<Node>().Program = "nonesuch";
            node.SetActive(true);
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("nonesuch").And.StringContaining("0"));
        }

        [Test]
        public void An_unknown_schema_is_reported()
        {
            Configure("double", settings => settings.schema = "nowhere.NowhereSchema");
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("nowhere.NowhereSchema"));
        }

        [Test]
        public void A_throwing_sensor_is_reported_and_its_node_skips_the_round()
        {
            var good = MakeNode(1);
            var bad = MakeNode(1);
            bad.Node.gameObject.AddComponent<ThrowingSensor>();
            Play(1);
            Assert.That(good.Answer, Is.EqualTo(2));
            Assert.That(bad.Actuator.Calls, Is.EqualTo(0));
            Assert.That(Errors.Count, Is.EqualTo(1));
            Assert.That(Errors[0], Is.StringContaining("ThrowingSensor"));
            Assert.That(Manager.ErrorCount, Is.EqualTo(1));
        }

        [Test]
        public void A_sensor_that_keeps_throwing_is_disabled_and_its_node_continues()
        {
            var node = MakeNode(1);
            var sensor = node.Node.gameObject.AddComponent<ThrowingSensor>();
            Play(9);
            Assert.That(sensor.enabled, Is.True);
            Play(1);
            Assert.That(sensor.enabled, Is.False);
            Assert.That(Errors[Errors.Count - 1], Is.StringContaining("ThrowingSensor").And.StringContaining("disabled"));
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(2));
        }

        [Test]
        public void The_same_error_of_many_sensors_is_logged_once_and_counted()
        {
            for (var i = 0; i < 12; i++) MakeNode(1).Node.gameObject.AddComponent<ThrowingSensor>();
            Play(10);
            Assert.That(Errors.Count, Is.EqualTo(5));
            Assert.That(Errors[0], Is.StringContaining("ThrowingSensor of node 0").And.StringContaining("at tick 1"));
            Assert.That(Errors[1], Is.StringContaining("10 calls of ThrowingSensor").And.StringContaining("node 9"));
            Assert.That(Errors[2], Is.StringContaining("100 calls of ThrowingSensor"));
            Assert.That(Errors[3], Is.StringContaining("is disabled"));
            Assert.That(Errors[4], Is.StringContaining("10 components ThrowingSensor were disabled"));
            Assert.That(Manager.ErrorCount, Is.EqualTo(120));
            Manager.enabled = false;
            Assert.That(Errors[5], Is.StringContaining("120 calls of ThrowingSensor"));
            Assert.That(Errors[6], Is.StringContaining("12 components ThrowingSensor").And.StringContaining("node 11"));
        }

        [Test]
        public void A_sensor_for_another_schema_stops_the_simulation_with_both_types()
        {
            var node = MakeNode(1);
            node.Node.gameObject.AddComponent<ForeignSensor>();
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("ForeignSensor").And.StringContaining("probe.SensorData"));
        }

        [Test]
        public void A_scene_that_cannot_be_built_stops_the_simulation()
        {
            new GameObject("scene").AddComponent<BrokenScene>();
            Assert.That(Manager.Failure, Is.StringContaining("BrokenScene").And.StringContaining("broken on purpose"));
        }

        [Test]
        public void Settings_out_of_range_are_rejected_before_the_start()
        {
            Configure("double", settings => settings.deltaTime = 0);
            MakeNode(1);
            UnityEngine.Headless.Loop.Frame(0.05f);
            Assert.That(Manager.Failure, Is.StringContaining("delta time"));
        }

        [Test]
        public void Nodes_without_a_manager_are_reported_once_after_a_frame()
        {
            Object.DestroyImmediate(Manager.gameObject);
            MakeNode(1).Node.name = "lonely";
            MakeNode(1);
            Log.Clear();
            for (var i = 0; i < 3; i++) UnityEngine.Headless.Loop.Frame(0.05f);
            Assert.That(Errors, Is.Empty);
            Assert.That(Log.Count, Is.EqualTo(1));
            Assert.That(Log[0], Is.StringContaining("lonely").And.StringContaining("no loaded scene has a Simulation Manager"));
        }

        [Test]
        public void Nodes_whose_manager_comes_with_a_later_scene_are_not_reported()
        {
            Object.DestroyImmediate(Manager.gameObject);
            var node = MakeNode(1);
            Log.Clear();
            UnityEngine.Headless.Loop.Frame(0.05f);
            MakeManager("double");
            for (var i = 0; i < 3; i++) UnityEngine.Headless.Loop.Frame(0.05f);
            Assert.That(Log.FindAll(line => line.Contains("Simulation Manager")), Is.Empty);
            Assert.That(node.Answer, Is.EqualTo(2));
        }

        [Test]
        public void Nodes_of_an_additive_scene_join_and_leave_with_it()
        {
            MakeNode(1);
            Play(1);
            var scene = UnityEngine.Headless.AdditiveScene.Load("More", () =>
            {
                MakeNode(2);
                MakeNode(3);
            });
            Play(1);
            Assert.That(Manager.Nodes.Count, Is.EqualTo(3));
            UnityEngine.Headless.AdditiveScene.Unload(scene);
            Play(1);
            Assert.That(Manager.Nodes.Count, Is.EqualTo(1));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_simulation_ends_with_the_scene_of_its_manager_and_nodes_wait_for_the_next()
        {
            Object.DestroyImmediate(Manager.gameObject);
            var node = MakeNode(4);
            SimulationManager manager = null;
            for (var i = 0; i < 2; i++)
            {
                var scene = UnityEngine.Headless.AdditiveScene.Load("Manager", () => manager = MakeManager("double"));
                UnityEngine.Headless.Loop.Frame(0.05f);
                Assert.That((SimulationManager.Current == manager, node.Node.Id), Is.EqualTo((true, 0)));
                Assert.That(node.Answer, Is.EqualTo(8));
                UnityEngine.Headless.AdditiveScene.Unload(scene);
                Assert.That((SimulationManager.Current == null, node.Node.Id), Is.EqualTo((true, -1)));
            }
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_part_that_moves_to_another_node_works_for_that_node()
        {
            Configure("double");
            var first = MakeNode(1);
            var second = MakeNode(2);
            var arm = new GameObject("Arm");
            arm.transform.SetParent(first.Node.transform);
            var sensor = arm.AddComponent<ProbeSensor>();
            sensor.Value = 10;
            Play(1);
            Assert.That((first.Answer, second.Answer), Is.EqualTo((20f, 4f)));
            new GameObject("Shoulder").transform.SetParent(second.Node.transform);
            arm.transform.SetParent(second.Node.transform.GetChild(0));
            Play(1);
            Assert.That(sensor.Node, Is.SameAs(second.Node));
            Assert.That((first.Answer, second.Answer), Is.EqualTo((2f, 20f)));
            second.Node.transform.GetChild(0).SetParent(first.Node.transform);
            Play(1);
            Assert.That((first.Answer, second.Answer), Is.EqualTo((20f, 4f)), "the sensor must follow its parent to the other node");
            arm.transform.SetParent(null);
            Assert.That(sensor.enabled, Is.False);
            Assert.That(Errors[0], Is.StringContaining("has no Node on its GameObject or its parents"));
        }

        [Test]
        public void Parts_join_a_node_that_is_added_or_replaced()
        {
            Configure("double");
            var outer = MakeNode(1);
            var inner = new GameObject("Inner");
            inner.transform.SetParent(outer.Node.transform);
            var sensor = inner.AddComponent<ProbeSensor>();
            sensor.Value = 10;
            var actuator = inner.AddComponent<ProbeActuator>();
            Play(1);
            Assert.That(outer.Answer, Is.EqualTo(20));
            inner.AddComponent<Node>();
            Play(1);
            Assert.That((outer.Answer, actuator.Last.Value), Is.EqualTo((2f, 20f)));
            UnityEngine.Object.DestroyImmediate(inner.GetComponent<Node>());
            inner.AddComponent<Node>();
            sensor.Value = 30;
            Play(1);
            Assert.That(actuator.Last.Value, Is.EqualTo(60));
        }

        [Test]
        public void Parts_of_a_child_whose_node_is_destroyed_join_the_parent()
        {
            Configure("double");
            var outer = MakeNode(1);
            var inner = MakeNode(10);
            inner.Node.transform.SetParent(outer.Node.transform);
            Play(1);
            Assert.That(outer.Answer, Is.EqualTo(2));
            UnityEngine.Object.Destroy(inner.Node);
            Play(2);
            Assert.That((outer.Answer, inner.Answer), Is.EqualTo((20f, 20f)));
            Assert.That(inner.Sensor.Node, Is.SameAs(outer.Node));
        }

        [Test]
        public void An_exception_in_a_Logged_handler_stops_no_tick()
        {
            Configure("trouble");
            MakeNode(20);
            var lines = 0;
            Manager.Logged += (level, line) =>
            {
                lines++;
                throw new System.InvalidOperationException("log me");
            };
            Play(4);
            Assert.That(Manager.Tick, Is.EqualTo(4));
            Assert.That(lines, Is.GreaterThan(1));
            Assert.That(Errors, Has.Some.Contains("log me"));
        }

        [Test]
        public void Nodes_that_outlive_their_manager_join_the_next_one_without_state()
        {
            Configure("count");
            var node = MakeNode(0);
            Play(3);
            Object.DestroyImmediate(Manager.gameObject);
            Assert.That(node.Node.Id, Is.EqualTo(-1));
            UnityEngine.Headless.Loop.Frame(0.05f);
            Assert.That(node.Actuator.Calls, Is.EqualTo(3));
            var next = MakeManager("count");
            for (var i = 0; i < 2; i++) UnityEngine.Headless.Loop.Frame(0.05f);
            Assert.That(next.Nodes, Is.EqualTo(new[] { node.Node }));
            Assert.That(node.Answer, Is.EqualTo(2));
            Assert.That(Errors, Is.Empty);
        }

        [TestCase(typeof(SelfDestroyingSensor))]
        [TestCase(typeof(SelfDestroyingActuator))]
        [TestCase(typeof(SelfDestroyingRule))]
        public void A_component_can_destroy_itself_in_its_own_call(System.Type type)
        {
            Configure("sum");
            var node = MakeNode(3);
            var other = MakeNode(4, Vector3.right);
            // The failing component has components of the same kind before and after it.
            node.Node.gameObject.AddComponent(type);
            var second = node.Node.gameObject.AddComponent<ProbeSensor>();
            second.Value = 5;
            var last = node.Node.gameObject.AddComponent<ProbeActuator>();
            node.Node.gameObject.AddComponent<RadiusNeighbourhood>();
            Play(2);
            Assert.That(node.Node.GetComponent(type) == null, Is.True);
            Assert.That(other.Answer, Is.EqualTo(5), "the sensor after the failing one must be called");
            Assert.That(last.Calls, Is.EqualTo(2), "the actuator after the failing one must be called");
            Assert.That(Manager.LinkCount, Is.EqualTo(2));
            Assert.That(Errors, Is.Empty);
        }

        [TestCase(typeof(NodeDestroyingSensor))]
        [TestCase(typeof(NodeDestroyingRule))]
        public void A_component_can_destroy_its_own_node(System.Type type)
        {
            var node = MakeNode(3);
            var other = MakeNode(4, Vector3.right);
            other.Node.gameObject.AddComponent<RadiusNeighbourhood>();
            node.Node.gameObject.AddComponent<RadiusNeighbourhood>();
            node.Node.gameObject.AddComponent(type);
            Play(2);
            Assert.That(Manager.Nodes, Is.EqualTo(new[] { other.Node }));
            Assert.That(other.Answer, Is.EqualTo(8));
            Assert.That(Manager.LinkCount, Is.EqualTo(0));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_component_that_destroys_its_node_and_throws_does_not_stop_the_simulation()
        {
            var node = MakeNode(3);
            var other = MakeNode(4, Vector3.right);
            node.Node.gameObject.AddComponent<NodeDestroyingSensor>().Throws = true;
            Play(2);
            Assert.That((Manager.Failure, other.Answer), Is.EqualTo(("", 8f)));
            Assert.That(Errors, Has.Count.EqualTo(1).And.Some.StringContaining("NodeDestroyingSensor of node -1"));
        }

        [Test]
        public void A_component_that_toggles_itself_is_called_once_per_tick()
        {
            var node = MakeNode(3);
            var sensor = node.Node.gameObject.AddComponent<TogglingSensor>();
            Play(4);
            Assert.That(sensor.Calls, Is.EqualTo(4));
        }

        [Test]
        public void An_actuator_that_keeps_throwing_is_disabled_and_the_others_continue()
        {
            var node = MakeNode(1);
            var bad = node.Node.gameObject.AddComponent<ThrowingActuator>();
            Play(12);
            Assert.That(bad.enabled, Is.False);
            Assert.That(Manager.ErrorCount, Is.EqualTo(10));
            Assert.That(node.Actuator.Calls, Is.EqualTo(12));
            Assert.That(Errors[0], Is.StringContaining("ThrowingActuator").And.StringContaining("tick 1: broken on purpose"));
        }

        [Test]
        public void A_rule_that_keeps_throwing_is_disabled_and_the_others_continue()
        {
            Configure("sum");
            var node = MakeNode(1);
            var other = MakeNode(2, Vector3.right);
            var bad = node.Node.gameObject.AddComponent<ThrowingRule>();
            node.Node.gameObject.AddComponent<RadiusNeighbourhood>();
            Play(12);
            Assert.That(bad.enabled, Is.False);
            Assert.That(Manager.ErrorCount, Is.EqualTo(10));
            Assert.That(other.Answer, Is.EqualTo(1));
        }

        [Test]
        public void Nodes_at_the_same_position_are_reported_and_keep_running()
        {
            for (var i = 0; i < 50; i++) MakeNode(i, Vector3.one).Node.gameObject.AddComponent<RadiusNeighbourhood>();
            MakeNode(0, Vector3.one).Node.gameObject.AddComponent<KNearestNeighbourhood>();
            MakeNode(0, Vector3.one).Node.gameObject.AddComponent<LineOfSightNeighbourhood>();
            Play(2);
            Assert.That(Log.FindAll(line => line.Contains("all 52 nodes have the same position")).Count, Is.EqualTo(1));
            Assert.That(Manager.LinkCount, Is.EqualTo(52 * 51));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_scale_of_zero_is_reported_and_has_no_other_effect()
        {
            var node = MakeNode(1);
            node.Node.name = "flat";
            node.Node.transform.localScale = new Vector3(1, 0, 1);
            node.Node.gameObject.AddComponent<SphereCollider>();
            node.Node.gameObject.AddComponent<SensorTests.Obstacles>();
            node.Node.gameObject.AddComponent<SensorTests.Rays>();
            node.Node.gameObject.AddComponent<LineOfSightNeighbourhood>();
            MakeNode(2, Vector3.right);
            Play(2);
            Assert.That(Log.FindAll(line => line.Contains("flat") && line.Contains("scale of zero")).Count, Is.EqualTo(1));
            Assert.That(Errors, Is.Empty);
            Assert.That(node.Answer, Is.EqualTo(2));
        }

        [Test]
        public void A_simulation_stops_after_its_time_or_by_condition_and_can_continue()
        {
            Configure("count", settings => settings.stopAfter = 0.2f);
            var node = MakeNode(0);
            Play(10);
            Assert.That(Manager.Finished && Manager.Paused, Is.True);
            Assert.That(node.Answer, Is.EqualTo(4));
            Manager.Paused = false;
            Play(2);
            Assert.That(node.Answer, Is.EqualTo(6));
            Configure("count", settings => settings.stopAfter = 0);
            Manager.StopCondition = manager => manager.Tick == 3;
            Play(10);
            Assert.That(Manager.Finished, Is.True);
            Assert.That(node.Answer, Is.EqualTo(3));
        }

        [TestCase(0.001f, 3)]
        [TestCase(0.0013f, 2)] // 2.3 ticks
        public void A_simulation_that_stops_after_a_long_time_runs_the_nearest_number_of_ticks(float deltaTime, int ticks)
        {
            Configure("count", settings => (settings.deltaTime, settings.stopAfter) = (1000, 2000.003f));
            Loop.Frame(0);
            for (var tick = 0; tick < 2; tick++) Manager.Step();
            Manager.Settings.deltaTime = deltaTime;
            for (var tick = 1; tick < ticks; tick++) Manager.Step();
            Assert.That(Manager.Finished, Is.False);
            Manager.Step();
            Assert.That(Manager.Finished, Is.True);
        }

        [Test]
        public void Step_outside_a_running_simulation_is_reported_and_ignored()
        {
            Manager.Step();
            Assert.That(Errors, Is.EqualTo(new[] { "the simulation has not started: call Step in play mode, from Update or later" }));
            MakeNode(float.NaN);
            Play(1);
            Manager.Step();
            Assert.That(Errors[2], Is.StringStarting("the simulation has stopped: sensor data of node 0"));
        }

        [Test]
        public void Step_within_a_tick_is_rejected()
        {
            var node = MakeNode(1);
            node.Node.gameObject.AddComponent<SteppingActuator>();
            Play(2);
            Assert.That(Errors[0], Is.StringContaining("SteppingActuator").And.StringContaining("Step was called during a tick"));
            Assert.That(Manager.Tick, Is.EqualTo(2));
            Assert.That(node.Actuator.Calls, Is.EqualTo(2));
        }

        [Test]
        public void An_id_above_the_maximum_stops_the_simulation()
        {
            MakeNode(1, default, 1 << 24);
            Assert.That(Manager.Failure, Is.EqualTo("node 'Probe' has id 16777216, but the largest id is 16777215: use smaller ids, or -1"));
        }

        [Test]
        public void Removing_a_link_that_no_script_added_is_reported_and_ignored()
        {
            var node = MakeNode(1);
            MakeNode(2, Vector3.right).Node.gameObject.AddComponent<RadiusNeighbourhood>();
            Play(1);
            Manager.RemoveLink(0, 1);
            Assert.That(Log, Has.Some.EqualTo("cannot remove the link from node 0 to node 1: no script added it"));
            Play(1);
            Assert.That(Manager.LinkCount, Is.EqualTo(2));
            Assert.That(node.Actuator.Calls, Is.EqualTo(2));
        }

        [Test]
        public void A_component_without_a_node_is_reported_and_works_once_it_has_one()
        {
            var holder = new GameObject("stray");
            var sensor = holder.AddComponent<ProbeSensor>();
            var actuator = holder.AddComponent<ProbeActuator>();
            Assert.That(sensor.enabled || actuator.enabled, Is.False);
            Assert.That(Errors[0], Is.EqualTo("ProbeSensor on 'stray' has no Node on its GameObject or its parents: add the component Collektive/Node"));
            holder.AddComponent<Node>();
            sensor.Value = 4;
            sensor.enabled = true;
            actuator.enabled = true;
            Play(1);
            Assert.That(actuator.Last.Value, Is.EqualTo(8));
        }

        [Test]
        public void A_node_outside_a_simulation_has_no_random_numbers()
        {
            var node = MakeNode(1).Node;
            Assert.That(node.Random, Is.Not.Null);
            node.enabled = false;
            Assert.That(Assert.Throws<InvalidOperationException>(() => node.Random.NextDouble()).Message, Is.StringContaining("node 'Probe'"));
        }

        [Test]
        public void JVM_settings_that_differ_from_the_running_JVM_are_reported_and_the_simulation_continues()
        {
            MakeNode(1);
            Play(1);
            Configure("double", settings => settings.jvm.settings.compileThreshold = 50);
            Play(2);
            const string warning = "The running JVM is used; the new settings take effect after a restart of the editor.";
            Assert.That(Log.Any(line => line.Contains(warning)), Is.EqualTo(TestJvm.Placement == JvmPlacement.InProcess));
            Assert.That(Jvm.GetStatus().Options.Contains("-XX:CompileThresholdScaling=0.5"), Is.EqualTo(TestJvm.Placement == JvmPlacement.OwnProcess));
            Assert.That(Manager.Tick, Is.EqualTo(2));
            Assert.That(Errors, Is.Empty);
        }

        [Test, Category("OwnProcess")]
        public void A_JVM_in_a_separate_process_stops_after_the_session_unless_it_is_kept_warm()
        {
            MakeNode(1);
            Configure("double", settings => settings.jvm.settings.keepWarm = false);
            Play(1);
            Manager.enabled = false;
            Assert.That(Jvm.State, Is.EqualTo(JvmState.Stopped));
            Configure("double");
            Play(1);
            Manager.enabled = false;
            Assert.That(Jvm.State, Is.EqualTo(JvmState.Running));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Clicking_an_error_selects_the_failed_component()
        {
            var sensor = MakeNode(1).Node.gameObject.AddComponent<ThrowingSensor>();
            var actuator = MakeNode(1, Vector3.right).Node.gameObject.AddComponent<ThrowingActuator>();
            var rule = actuator.gameObject.AddComponent<ThrowingRule>();
            var selected = new Selection(() => Play(10));
            Assert.That(selected.By("ThrowingSensor of node"), Is.SameAs(sensor));
            Assert.That(selected.By("ThrowingActuator of node"), Is.SameAs(actuator));
            Assert.That(selected.By("ThrowingRule of node"), Is.SameAs(rule));
            Assert.That(selected.By("ThrowingSensor on 'Probe' failed 10 times"), Is.SameAs(sensor));
            var foreign = actuator.gameObject.AddComponent<ForeignActuator>();
            Assert.That(new Selection(() => Play(1)).By("ForeignActuator"), Is.SameAs(foreign));
            Assert.That(Manager.Failure, Is.StringContaining("ForeignActuator").And.StringContaining("probe.ActuatorData"));
        }

        [Test]
        public void Clicking_a_message_selects_its_node()
        {
            Configure("trouble");
            var flat = MakeNode(0, Vector3.one).Node;
            flat.transform.localScale = Vector3.zero;
            var bad = MakeNode(13, Vector3.one);
            var selected = new Selection(() => Play(1));
            Assert.That(selected.By("scale of zero"), Is.SameAs(flat));
            Assert.That(selected.By("the same position"), Is.SameAs(flat));
            Assert.That(selected.By("thirteen"), Is.SameAs(bad.Node));
            bad.Sensor.Value = float.NaN;
            Assert.That(new Selection(() => Play(1)).By("not finite"), Is.SameAs(bad.Node));
            Object.DestroyImmediate(Manager.gameObject);
            Node lonely = null;
            selected = new Selection(() =>
            {
                lonely = MakeNode(1).Node;
                UnityEngine.Headless.Loop.Frame(0.05f);
                UnityEngine.Headless.Loop.Frame(0.05f);
            });
            Assert.That(selected.By("a Simulation Manager"), Is.SameAs(lonely));
        }

        [Test]
        public void An_exception_in_a_tick_stops_the_simulation_and_is_logged()
        {
            MakeNode(1);
            Play(2);
            Manager.SetGlobals<probe.GlobalData>(data => throw new InvalidOperationException("broken writer"));
            Play(3);
            Assert.That(Manager.Failure, Is.EqualTo("tick 3 failed: broken writer"));
            Assert.That(Errors, Has.Some.StringContaining("InvalidOperationException"));
        }

        [Test]
        public void An_exception_at_the_start_stops_the_simulation_and_is_logged()
        {
            Configure("double", settings => settings.jars.Add("no\0file"));
            MakeNode(1);
            Play(3);
            Assert.That(Manager.Failure, Is.StringContaining("the start failed"));
            Assert.That(Errors.Count, Is.EqualTo(2), "only the exception and the stop may be logged");
        }

        [Test]
        public void Invalid_delta_times_and_physics_steps_are_rejected()
        {
            var settings = new SimulationSettings { jars = { "a.jar" } };
            Assert.That(settings.FindProblem(), Is.Null);
            foreach (var deltaTime in new[] { 0, -1, float.NaN, float.PositiveInfinity, 1e-30f })
            {
                settings.deltaTime = deltaTime;
                Assert.That(settings.FindProblem(), Is.StringStarting("delta time is "));
            }
            settings.deltaTime = 0.05f;
            settings.physicsStep = 1e-30f;
            Assert.That(settings.FindProblem(), Is.StringStarting("physics step is "));
        }

        [Test]
        public void A_seed_that_is_set_after_the_manager_was_enabled_is_an_error()
        {
            MakeNode(1);
            Manager.Settings.seed = 7;
            Play(1);
            Assert.That(Manager.Failure, Is.StringStarting("seed is 7, but the Simulation Manager was enabled with seed 1: "));
        }

        [Test]
        public void A_schedule_and_a_seed_that_are_set_during_play_apply_to_no_node()
        {
            var first = MakeNode(1);
            Play(1);
            var expected = new RandomStream(1, 1, RandomPurpose.Node).NextDouble();
            Manager.Settings.seed = 7;
            Manager.Settings.schedule = Schedule.Asynchronous;
            Manager.Settings.timing.period = 1;
            var second = MakeNode(1, Vector3.one);
            Play(10);
            Assert.That((first.Actuator.Calls, second.Actuator.Calls), Is.EqualTo((11, 10)));
            Assert.That(second.Node.Random.NextDouble(), Is.EqualTo(expected));
        }

        [Test]
        public void A_parameter_without_a_name_is_reported_with_its_node()
        {
            MakeNode(1).Node.Parameters.Add(default);
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("node 0").And.StringContaining("''"));
        }

        [Test]
        public void A_parameter_with_two_values_is_reported_with_its_node()
        {
            MakeNode(1);
            MakeNode(1).Node.Parameters.AddRange(new[] { new NodeParameter("a", "1"), new NodeParameter("b", "1"), new NodeParameter("a", "2") });
            Play(1);
            Assert.That(Manager.Failure, Is.EqualTo("node 1 ('Probe'): parameter 'a' has two values: remove one of them"));
        }

        [TestCase("physicsStep", float.NaN)]
        [TestCase("physicsStep", 0)]
        [TestCase("physicsStep", 0.05f)]
        [TestCase("deltaTime", float.NaN)]
        [TestCase("deltaTime", -1)]
        [TestCase("deltaTime", 0)]
        public void Invalid_times_that_are_set_during_play_stop_the_simulation(string field, float value)
        {
            MakeNode(1);
            Play(2);
            typeof(SimulationSettings).GetField(field).SetValue(Manager.Settings, value);
            Loop.Frame(0.05f);
            Assert.That(Manager.Failure, Is.StringContaining(" is " + value + " s: it must be greater than 0"));
        }

        [TestCase("stopAfter", float.NaN, "stop after is NaN s: it must be 0 or greater")]
        [TestCase("threads", 0, "threads is 0: it must be from 1 to 256")]
        [TestCase("threads", 257, "threads is 257: it must be from 1 to 256")]
        [TestCase("stepLimitMs", 0, "step limit is 0 ms: it must be at least 1")]
        public void Invalid_settings_that_are_set_during_play_stop_the_simulation(string field, object value, string problem)
        {
            MakeNode(1);
            Play(2);
            typeof(SimulationSettings).GetField(field).SetValue(Manager.Settings, value);
            Play(1);
            Assert.That(Manager.Failure, Is.EqualTo(problem));
        }

        [Test]
        public void Clicking_a_rejection_selects_the_rejected_object()
        {
            Configure("double", settings => settings.schedule = Schedule.Asynchronous);
            var node = MakeNode(1, default, 5).Node;
            node.OwnTiming = true;
            node.Timing.period = 0;
            var second = new GameObject("Second");
            Assert.That(new Selection(() => second.AddComponent<SimulationManager>()).By("second Simulation Manager"),
                Is.SameAs(second.GetComponent<SimulationManager>()));
            Assert.That(new Selection(() => Play(1)).By("period is 0"), Is.SameAs(node));
            Configure("double");
            Node twin = null;
            Assert.That(new Selection(() => twin = MakeNode(1, default, 5).Node).By("has id 5"), Is.SameAs(twin));
            Object.DestroyImmediate(twin.gameObject);
            Configure("double");
            BrokenScene scene = null;
            Assert.That(new Selection(() => scene = new GameObject("scene").AddComponent<BrokenScene>()).By("could not be built"), Is.SameAs(scene));
            Configure("nonesuch");
            Assert.That(new Selection(() => Play(1)).By("nonesuch"), Is.SameAs(Manager));
        }

        /// <summary>A log handler that records which object a click on each message would select.</summary>
        private sealed class Selection : ILogHandler
        {
            private readonly List<KeyValuePair<string, Object>> messages = new List<KeyValuePair<string, Object>>();
            private readonly ILogHandler before = Debug.unityLogger.logHandler;

            internal Selection(Action act)
            {
                Debug.unityLogger.logHandler = this;
                act();
                Debug.unityLogger.logHandler = before;
            }

            public void LogFormat(LogType logType, Object context, string format, params object[] args)
            {
                messages.Add(new KeyValuePair<string, Object>(string.Format(format, args), context));
                before.LogFormat(logType, context, format, args);
            }

            public void LogException(Exception exception, Object context)
            {
                messages.Add(new KeyValuePair<string, Object>(exception.Message, context));
                before.LogException(exception, context);
            }

            internal Object By(string text)
            {
                foreach (var message in messages)
                {
                    if (message.Key.Contains(text)) return message.Value;
                }
                throw new AssertionException("no message contains '" + text + "'");
            }
        }

        public sealed class SteppingActuator : Actuator<probe.ActuatorData>
        {
            protected override void Act(probe.ActuatorData data) => SimulationManager.Current.Step();
        }

        public sealed class SelfDestroyingSensor : Sensor<probe.SensorData>
        {
            protected override void Sense(ref probe.SensorData data) => Object.DestroyImmediate(this);
        }

        public sealed class SelfDestroyingActuator : Actuator<probe.ActuatorData>
        {
            protected override void Act(probe.ActuatorData data) => Object.DestroyImmediate(this);
        }

        public sealed class SelfDestroyingRule : NeighbourhoodRule
        {
            protected override void FindNeighbours(NeighbourCollector neighbours)
            {
                foreach (var node in neighbours.Nodes) neighbours.Add(node);
                Object.DestroyImmediate(this);
            }
        }

        public sealed class NodeDestroyingSensor : Sensor<probe.SensorData>
        {
            public bool Throws { get; set; }

            protected override void Sense(ref probe.SensorData data)
            {
                Object.DestroyImmediate(Node.gameObject);
                if (Throws) throw new InvalidOperationException("broken on purpose");
            }
        }

        public sealed class NodeDestroyingRule : NeighbourhoodRule
        {
            protected override void FindNeighbours(NeighbourCollector neighbours)
            {
                foreach (var node in neighbours.Nodes) neighbours.Add(node);
                Object.DestroyImmediate(Node.gameObject);
            }
        }

        public sealed class TogglingSensor : Sensor<probe.SensorData>
        {
            public int Calls { get; private set; }

            protected override void Sense(ref probe.SensorData data)
            {
                Calls++;
                enabled = false;
                enabled = true;
            }
        }

        public sealed class ThrowingActuator : Actuator<probe.ActuatorData>
        {
            protected override void Act(probe.ActuatorData data) => throw new InvalidOperationException("broken on purpose");
        }

        public sealed class ThrowingRule : NeighbourhoodRule
        {
            protected override void FindNeighbours(NeighbourCollector neighbours) => throw new InvalidOperationException("broken on purpose");
        }

        public sealed class ThrowingSensor : Sensor<probe.SensorData>
        {
            protected override void Sense(ref probe.SensorData data) => throw new InvalidOperationException("broken on purpose");
        }

        public sealed class BrokenScene : SceneBuilder
        {
            protected override void Build(SimulationManager manager) => throw new InvalidOperationException("broken on purpose");
        }

        public sealed class ForeignActuator : Actuator<int>
        {
            protected override void Act(int data)
            {
            }
        }

        public sealed class ForeignSensor : Sensor<int>
        {
            protected override void Sense(ref int data)
            {
            }
        }
    }
}
