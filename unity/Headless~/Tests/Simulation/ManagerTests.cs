using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using probe;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Simulation
{
    [TestFixture]
    public sealed class ManagerTests : SimulationFixture
    {
        [Test]
        public void Scripts_can_set_the_id_of_an_active_node_before_its_first_tick()
        {
            Configure("sum");
            var nodes = new List<Node>();
            foreach (var id in new[] { 7, 3, -1, 0 })
            {
                nodes.Add(new GameObject("Node").AddComponent<Node>());
                nodes[nodes.Count - 1].RequestedId = id;
            }
            Assert.That(nodes.ConvertAll(node => node.Id), Is.EqualTo(new[] { 7, 3, 8, 0 }));
            Play(1);
            nodes[1].RequestedId = 4;
            Assert.That(nodes[1].Id, Is.EqualTo(3));
            nodes.Add(new GameObject("Node").AddComponent<Node>());
            nodes[4].RequestedId = 7;
            Assert.That(Manager.Failure, Is.StringContaining("has id 7, which node"));
        }

        [Test]
        public void A_node_without_requested_id_gives_its_id_to_a_node_that_requests_it()
        {
            Configure("sum");
            var nodes = new List<Node>();
            for (var i = 0; i < 3; i++) nodes.Add(new GameObject("Node").AddComponent<Node>());
            nodes[0].RequestedId = 1;
            Assert.That(nodes.ConvertAll(node => node.Id), Is.EqualTo(new[] { 1, 3, 2 }));
            nodes[1].RequestedId = 0;
            Assert.That(nodes.ConvertAll(node => node.Id), Is.EqualTo(new[] { 1, 0, 2 }));
            Play(1);
            Assert.That(Manager.Failure, Is.Empty);
        }

        [Test]
        public void Node_positions_are_sampled_at_the_start_of_the_tick()
        {
            var node = MakeNode(1, Vector3.right).Node;
            Assert.That(node.Position, Is.EqualTo(Vector3.right), "the position must be readable before the first tick");
            Play(1);
            node.transform.position = Vector3.up;
            Assert.That(node.Position, Is.EqualTo(Vector3.right));
            Play(1);
            Assert.That(node.Position, Is.EqualTo(Vector3.up));
        }

        [Test]
        public void A_round_reads_sensors_and_drives_actuators()
        {
            var node = MakeNode(21);
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(42));
            Assert.That(node.Actuator.Calls, Is.EqualTo(1));
        }

        [Test]
        public void Ticks_follow_simulated_time_and_not_the_frame_rate()
        {
            MakeNode(0);
            for (var i = 0; i < 10; i++) Loop.Frame(0.02f);
            Assert.That(Manager.Tick, Is.EqualTo(4));
            Loop.Frame(0.1f);
            Assert.That(Manager.Tick, Is.EqualTo(6));
        }

        [Test]
        public void A_long_frame_runs_a_bounded_number_of_ticks()
        {
            MakeNode(0);
            Loop.Frame(10);
            Assert.That(Manager.Tick, Is.EqualTo(4));
            Loop.Frame(0.05f);
            Assert.That(Manager.Tick, Is.EqualTo(5));
        }

        [Test]
        public void While_paused_calls_physics_and_time_stop()
        {
            var node = MakeNode(1, new Vector3(0, 10, 0));
            var body = node.Node.gameObject.AddComponent<Rigidbody>();
            node.Node.gameObject.AddComponent<SphereCollider>();
            Play(2);
            var calls = Jvm.StepCalls;
            var time = Manager.SimulatedTime;
            var height = body.position.y;
            Manager.Paused = true;
            Play(5);
            Assert.That(Jvm.StepCalls, Is.EqualTo(calls));
            Assert.That(Manager.SimulatedTime, Is.EqualTo(time));
            Assert.That(body.position.y, Is.EqualTo(height));
            Manager.Step();
            Assert.That(Manager.SimulatedTime, Is.GreaterThan(time));
            Assert.That(body.position.y, Is.LessThan(height));
        }

        [Test]
        public void Time_and_delta_time_reach_the_program()
        {
            Configure("clock", settings => settings.deltaTime = 0.1f);
            var node = MakeNode(0);
            Play(3);
            Assert.That(node.Answer, Is.EqualTo(0.2f).Within(1e-6f));
            Assert.That(node.Actuator.Last.Heard, Is.EqualTo(100));
        }

        [Test]
        public void Each_node_can_have_its_own_program_and_parameters()
        {
            var first = MakeNode(2);
            var second = new GameObject("Scaled");
            second.SetActive(false);
            var node = second.AddComponent<Node>();
            node.Program = "scaled";
            node.Parameters.Add(new NodeParameter("factor", "10"));
            second.AddComponent<ProbeSensor>().Value = 2;
            var actuator = second.AddComponent<ProbeActuator>();
            second.SetActive(true);
            Play(1);
            Assert.That(first.Answer, Is.EqualTo(4));
            Assert.That(actuator.Last.Value, Is.EqualTo(20));
        }

        [Test]
        public void A_parameter_of_a_program_can_be_changed_between_two_ticks()
        {
            Configure("scaled");
            var node = MakeNode(2);
            var own = new GameObject("Own");
            own.SetActive(false);
            own.AddComponent<Node>().Parameters.Add(new NodeParameter("factor", "10"));
            own.AddComponent<ProbeSensor>().Value = 2;
            var actuator = own.AddComponent<ProbeActuator>();
            own.SetActive(true);
            Play(1);
            Manager.Simulation.SetParameter("scaled", "factor", "7");
            var later = MakeNode(3);
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(14));
            Assert.That(later.Answer, Is.EqualTo(21));
            Assert.That(actuator.Last.Value, Is.EqualTo(20), "a node must keep its own value");
        }

        [Test]
        public void Changed_parameters_of_a_node_take_effect_only_when_it_joins()
        {
            Configure("scaled");
            var node = MakeNode(2);
            node.Node.Parameters.Add(new NodeParameter("factor", "10"));
            Play(1);
            node.Node.Parameters[0] = new NodeParameter("factor", "20");
            node.Node.Parameters.Add(new NodeParameter("factor", "30"));
            var other = MakeNode(2);
            other.Node.Program = "double";
            Play(1);
            other.Node.Program = "scaled";
            Manager.Simulation.SetParameter("scaled", "factor", "7");
            Play(1);
            Assert.That(Manager.Failure, Is.Empty);
            Assert.That((node.Answer, other.Answer), Is.EqualTo((20f, 4f)));
        }

        [Test]
        public void The_programs_of_the_jar_are_listed_with_their_parameters()
        {
            MakeNode(0);
            Play(1);
            var names = new List<string>();
            foreach (var program in Manager.Programs) names.Add(program.Name);
            var expected = new[] { "arms", "clock", "count", "double", "far", "hops", "random", "ratio", "scaled", "sum", "trouble", "windy" };
            Assert.That(names, Is.EquivalentTo(expected));
            foreach (var program in Manager.Programs)
            {
                if (program.Name != "scaled") continue;
                Assert.That(program.Parameters.Count, Is.EqualTo(1));
                Assert.That(program.Parameters[0].Name, Is.EqualTo("factor"));
                Assert.That(program.Parameters[0].DefaultValue, Is.EqualTo("3"));
            }
        }

        [Test]
        public void Nodes_can_leave_and_rejoin_at_run_time_without_their_state()
        {
            Configure("count");
            var a = MakeNode(0);
            Play(3);
            var b = MakeNode(0);
            Play(2);
            Assert.That(a.Answer, Is.EqualTo(5));
            Assert.That(b.Answer, Is.EqualTo(2));
            a.Node.enabled = false;
            Play(2);
            Assert.That(a.Actuator.Calls, Is.EqualTo(5));
            Assert.That(b.Answer, Is.EqualTo(4));
            Assert.That(Manager.Nodes.Count, Is.EqualTo(1));
            a.Node.enabled = true;
            Play(1);
            Assert.That(a.Answer, Is.EqualTo(1));
            Object.Destroy(b.Node.gameObject);
            Play(2);
            Assert.That(Manager.Nodes.Count, Is.EqualTo(1));
            Assert.That(a.Answer, Is.EqualTo(3));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void An_id_can_be_reused_within_one_tick()
        {
            Configure("count");
            var a = MakeNode(0, default, 7);
            Play(3);
            a.Node.enabled = false;
            var b = MakeNode(0, default, 7);
            Play(1);
            Assert.That(b.Answer, Is.EqualTo(1));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Scripts_can_add_directed_and_undirected_links()
        {
            Configure("sum");
            var a = MakeNode(1);
            var b = MakeNode(10);
            var c = MakeNode(100);
            Manager.AddLink(a.Node.Id, b.Node.Id);
            Manager.AddLink(c.Node.Id, b.Node.Id, directed: true);
            Play(2);
            Assert.That(a.Answer, Is.EqualTo(10));
            Assert.That(b.Answer, Is.EqualTo(101));
            Assert.That(c.Answer, Is.EqualTo(0));
            Manager.RemoveLink(a.Node.Id, b.Node.Id);
            Play(1);
            Assert.That(a.Answer, Is.EqualTo(0));
            Assert.That(b.Answer, Is.EqualTo(100));
        }

        [Test]
        public void A_link_of_a_rule_and_a_script_exists_until_both_release_it()
        {
            Configure("sum");
            var a = MakeNode(1);
            var b = MakeNode(10, new Vector3(1, 0, 0));
            var rule = a.Node.gameObject.AddComponent<RadiusNeighbourhood>();
            rule.Radius = 2;
            Manager.AddLink(a.Node.Id, b.Node.Id);
            Play(2);
            rule.enabled = false;
            Play(1);
            Assert.That(a.Answer, Is.EqualTo(10));
            Manager.RemoveLink(a.Node.Id, b.Node.Id);
            Play(1);
            Assert.That(a.Answer, Is.EqualTo(0));
            Assert.That(Manager.LinkCount, Is.EqualTo(0));
        }

        [Test]
        public void Links_of_a_departed_node_are_removed_immediately()
        {
            var a = MakeNode(1);
            var b = MakeNode(10);
            Manager.AddLink(a.Node.Id, b.Node.Id);
            Play(1);
            var id = b.Node.Id;
            b.Node.enabled = false;
            var links = new List<Collektive.Bridge.LinkRecord>();
            Manager.CopyLinks(links);
            Assert.That(links, Is.Empty);
            Assert.That(Manager.LinkCount, Is.EqualTo(0));
            Assert.That(Manager.HasLink(a.Node.Id, id), Is.False);
            Play(1);
            Assert.That(Errors, Is.Empty);
        }

        [TestCase(false)]
        [TestCase(true)]
        public void A_node_that_leaves_in_a_sensor_is_heard_until_the_next_tick(bool readsLinks)
        {
            Configure("sum");
            var a = MakeNode(1);
            var b = MakeNode(10);
            b.Node.gameObject.AddComponent<RadiusNeighbourhood>().Radius = 2;
            var leaving = a.Node.gameObject.AddComponent<LeavingSensor>();
            leaving.ReadsLinks = readsLinks;
            Play(2);
            leaving.Victim = b.Node;
            Play(1);
            Assert.That(a.Answer, Is.EqualTo(10));
            Play(1);
            Assert.That(a.Answer, Is.EqualTo(0));
            Assert.That(Errors, Is.Empty);
        }

        public sealed class LeavingSensor : Sensor<SensorData>
        {
            public Node Victim;
            public bool ReadsLinks;

            protected override void Sense(ref SensorData data)
            {
                if (Victim == null) return;
                Victim.enabled = false;
                if (ReadsLinks) Assert.That(SimulationManager.Current.LinkCount, Is.EqualTo(0));
            }
        }

        [Test]
        public void Bodies_inside_a_trigger_zone_are_neighbours()
        {
            Configure("sum");
            var zone = MakeNode(1);
            var trigger = zone.Node.gameObject.AddComponent<SphereCollider>();
            trigger.isTrigger = true;
            trigger.radius = 2;
            zone.Node.gameObject.AddComponent<TriggerNeighbourhood>();
            var visitor = MakeNode(10, new Vector3(10, 0, 0));
            visitor.Node.gameObject.AddComponent<SphereCollider>().radius = 0.1f;
            var body = visitor.Node.gameObject.AddComponent<Rigidbody>();
            body.useGravity = false;
            body.isKinematic = true;
            Play(2);
            Assert.That(zone.Answer, Is.EqualTo(0));
            visitor.Node.transform.position = new Vector3(1, 0, 0);
            Play(3);
            Assert.That(zone.Answer, Is.EqualTo(10));
            Assert.That(visitor.Answer, Is.EqualTo(1));
            visitor.Node.transform.position = new Vector3(10, 0, 0);
            Play(3);
            Assert.That(zone.Answer, Is.EqualTo(0));
        }

        [Test]
        public void Random_numbers_depend_only_on_seed_and_node()
        {
            Configure("random", settings => settings.seed = 7);
            var a = MakeNode(0);
            Play(2);
            var drawn = a.Answer;
            Restart("random", settings => settings.seed = 7);
            a = MakeNode(0);
            MakeNode(0);
            Play(2);
            Assert.That(a.Answer, Is.EqualTo(drawn));
            Restart("random", settings => settings.seed = 8);
            a = MakeNode(0);
            Play(2);
            Assert.That(a.Answer, Is.Not.EqualTo(drawn));
        }

        [Test]
        public void A_second_manager_disables_itself_and_the_first_continues()
        {
            var second = new GameObject("Second").AddComponent<SimulationManager>();
            Assert.That(second.enabled, Is.False);
            Assert.That(Errors.Count, Is.EqualTo(1));
            Assert.That(Errors[0], Is.StringContaining("second Simulation Manager"));
            var node = MakeNode(1);
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(2));
            Assert.That(SimulationManager.Current, Is.SameAs(Manager));
        }

        [Test]
        public void A_re_enabled_manager_starts_a_new_simulation()
        {
            Configure("count");
            var a = MakeNode(0);
            var b = MakeNode(0);
            Manager.AddLink(a.Node.Id, b.Node.Id);
            Play(3);
            Manager.enabled = false;
            Manager.enabled = true;
            Assert.That(Manager.LinkCount, Is.EqualTo(0));
            Assert.That((Manager.Network, Manager.HostMicros, Manager.Times.Total), Is.EqualTo((new NetworkCounts(), (0, 0), 0.0)), "dashboard values");
            Play(2);
            Assert.That(Errors, Is.Empty);
            Assert.That(a.Answer, Is.EqualTo(2));
            Assert.That(Manager.Tick, Is.EqualTo(2));
        }

        [TestCase(false, 2)]
        [TestCase(true, 0)]
        public void A_manager_that_is_enabled_again_after_its_end_is_not_paused(bool isPaused, int ticks)
        {
            MakeNode(0);
            Manager.StopCondition = manager => !isPaused;
            Play(1);
            Assert.That(Manager.Finished, Is.Not.EqualTo(isPaused));
            Manager.StopCondition = null;
            if (isPaused) Manager.Paused = true;
            Manager.enabled = false;
            Manager.enabled = true;
            Play(2);
            Assert.That(Manager.Tick, Is.EqualTo(ticks));
        }

        [Test]
        public void Play_mode_can_be_entered_and_left_fifty_times()
        {
            for (var i = 0; i < 50; i++)
            {
                Restart("count");
                var node = MakeNode(0);
                Play(2);
                Assert.That(node.Answer, Is.EqualTo(2), "entry " + i);
            }
            Assert.That(Errors, Is.Empty);
        }

        private void Restart(string program, System.Action<SimulationSettings> change = null)
        {
            StopPlaying();
            StartPlaying();
            Configure(program, change);
        }
    }
}
