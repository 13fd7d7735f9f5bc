using System;
using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using probe;
using UnityEngine;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests schedules, sleeping nodes, previous answers and global data. Ticks are 0.05 s apart.</summary>
    [TestFixture]
    public sealed class ScheduleTests : SimulationFixture
    {
        [Test]
        public void Asynchronous_nodes_run_at_their_own_period()
        {
            Configure("count", Asynchronous(0.1f));
            var usual = MakeNode(0);
            var own = MakeTimedNode(new RoundTiming { period = 0.25f, phase = 0.05f });
            Play(1);
            Assert.That(usual.Answer, Is.EqualTo(1));
            Assert.That(own.Actuator.Calls, Is.EqualTo(0));
            Play(1);
            Assert.That(usual.Actuator.Calls, Is.EqualTo(1));
            Assert.That(own.Answer, Is.EqualTo(1));
            Play(18);
            Assert.That(usual.Answer, Is.EqualTo(10));
            Assert.That(own.Answer, Is.EqualTo(4));
            Assert.That(usual.Actuator.Calls, Is.EqualTo(10), "actuators must run only after a round of their node");
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Programs_read_the_time_since_their_last_round()
        {
            Configure("clock", Asynchronous(0.15f));
            var node = MakeNode(0);
            Play(4);
            Assert.That(node.Answer, Is.EqualTo(0.15f).Within(1e-6f));
            Assert.That(node.Actuator.Last.Heard, Is.InRange(149, 150), "milliseconds since the last round");
        }

        [TestCase(0f)]
        [TestCase(float.NaN)]
        [TestCase(0.04f)]
        public void An_invalid_period_is_rejected_before_the_start(float period)
        {
            Configure("count", Asynchronous(period));
            MakeNode(0);
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("period is " + period + " s"));
            Assert.That(Manager.Tick, Is.EqualTo(0));
        }

        [Test]
        public void An_invalid_period_of_one_node_is_rejected_with_the_node()
        {
            Configure("count", Asynchronous(0.1f));
            MakeNode(0);
            var bad = MakeTimedNode(new RoundTiming { period = 0.01f });
            Assert.That(bad.Node.Id, Is.EqualTo(1));
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("node 1").And.StringContaining("period is 0.01 s"));
        }

        [Test]
        public void A_period_shorter_than_an_increased_delta_time_is_rejected()
        {
            Configure("count", Asynchronous(0.2f));
            MakeNode(0);
            MakeTimedNode(new RoundTiming { period = 0.1f });
            Play(1);
            Manager.Settings.deltaTime = 0.1f;
            Play(1);
            Assert.That(Manager.Failure, Is.Empty);
            MakeTimedNode(new RoundTiming { period = 0.1f });
            Play(1);
            Manager.Settings.deltaTime = 0.05f;
            Play(1);
            Manager.Settings.deltaTime = 0.08f;
            Play(1);
            Assert.That(Manager.Failure, Is.Empty);
            Manager.Settings.deltaTime = 0.15f;
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("node 1").And.StringContaining("period is 0.1 s").And.StringContaining("delta time, 0.15 s"));
        }

        [Test]
        public void A_retention_shorter_than_an_increased_delta_time_is_rejected()
        {
            Configure("count", settings => settings.network.retention = 0.1);
            MakeNode(0);
            Play(1);
            // A change of the network takes effect at the next start.
            Manager.Settings.network.retention = 0.2;
            Manager.Settings.deltaTime = 0.15f;
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("network retention is 0.1 s"));
        }

        [Test]
        public void Times_that_an_actuator_changes_take_effect_in_the_next_tick()
        {
            Configure("clock", settings => settings.deltaTime = 0.1f);
            var node = MakeNode(0);
            var body = node.Node.gameObject.AddComponent<Rigidbody>();
            body.useGravity = false;
            body.linearVelocity = Vector3.right;
            var changer = node.Node.gameObject.AddComponent<TimeChanger>();
            changer.DeltaTime = 0.4f;
            Play(1);
            Assert.That(body.position.x, Is.EqualTo(0.1f).Within(1e-6f));
            Assert.That(node.Node.AnswerInterval, Is.EqualTo(0.1f));
            changer.PhysicsStep = 1e-30f;
            Manager.Step();
            Assert.That(body.position.x, Is.EqualTo(0.5f).Within(1e-6f));
            Assert.That(Manager.Failure, Is.Empty);
            Manager.Step();
            Assert.That(Manager.Failure, Is.StringContaining("more than a million steps"));
        }

        [Test]
        public void Timing_is_not_validated_if_the_schedule_ignores_it()
        {
            Configure("count", settings => settings.timing.period = float.NaN);
            var node = MakeTimedNode(new RoundTiming { period = 0 });
            Play(2);
            Assert.That(node.Answer, Is.EqualTo(2));
        }

        [TestCase(Schedule.Lockstep)]
        [TestCase(Schedule.Sequential)]
        [TestCase(Schedule.Asynchronous)]
        public void A_sleeping_node_keeps_its_state(Schedule schedule)
        {
            Configure("sum", Asynchronous(0.05f) + (settings => settings.schedule = schedule));
            var a = MakeNode(1);
            var b = MakeNode(10);
            a.Node.Program = "count";
            Rejoin(a);
            Manager.AddLink(b.Node.Id, a.Node.Id);
            Manager.AddLink(a.Node.Id, b.Node.Id);
            Play(3);
            var rounds = a.Answer;
            a.Node.Sleep(0.2);
            Play(4);
            Assert.That(a.Answer, Is.EqualTo(rounds));
            Play(1);
            Assert.That(a.Answer, Is.EqualTo(rounds + 1));
            a.Node.Sleep(double.PositiveInfinity);
            Play(20);
            Assert.That(a.Answer, Is.EqualTo(rounds + 1));
            a.Node.Sleep(0);
            Play(1);
            Assert.That(a.Answer, Is.EqualTo(rounds + 2));
        }

        [Test]
        public void Due_nodes_are_chosen_before_rules_and_sensors_run()
        {
            Configure("count");
            var node = MakeNode(0);
            node.Node.gameObject.AddComponent<SleepingRule>();
            Play(3);
            Assert.That(node.Answer, Is.EqualTo(1), "a rule made the node sleep, which must take effect in the next tick");
            Assert.That(Manager.Times.Queries, Is.GreaterThan(0));
        }

        [TestCase(true)]
        [TestCase(false)]
        public void Sleep_begins_at_the_next_tick_in_rules_and_in_actuators(bool isRule)
        {
            Configure("count");
            var node = MakeNode(0);
            var sleeper = isRule ? (Action<double>)(seconds => node.Node.gameObject.AddComponent<SleepingRule>().Seconds = seconds)
                : seconds => node.Node.gameObject.AddComponent<SleepingActuator>().Seconds = seconds;
            sleeper(0.1);
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(1));
            Play(2);
            Assert.That(node.Answer, Is.EqualTo(1));
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(2));
        }

        [Test]
        public void A_changed_delta_time_reaches_programs_once_it_has_passed()
        {
            Configure("clock", settings => settings.deltaTime = 0.1f);
            var node = MakeNode(0);
            Play(2);
            Manager.Settings.deltaTime = 0.2f;
            Manager.Step();
            Assert.That(node.Actuator.Last.Heard, Is.EqualTo(100));
            Manager.Step();
            Assert.That(node.Actuator.Last.Heard, Is.EqualTo(200));
        }

        [TestCase(Schedule.Lockstep)]
        [TestCase(Schedule.Sequential)]
        [TestCase(Schedule.Asynchronous)]
        public void The_last_answer_is_kept_until_the_next_answer(Schedule schedule)
        {
            Configure("count", Asynchronous(0.05f) + (settings => settings.schedule = schedule));
            var node = MakeNode(0);
            var other = MakeNode(0);
            Play(3);
            node.Node.Sleep(1);
            for (var tick = 0; tick < 6; tick++)
            {
                Expect(node, 3, 3);
                Expect(other, 3 + tick, (ulong)(3 + tick));
                Play(1);
            }
            node.Node.Sleep(0);
            Play(1);
            Expect(node, 4, 10);
            Assert.That(node.Node.AnswerTime, Is.EqualTo(Manager.SimulatedTime));
        }

        [Test]
        public void Asynchronous_nodes_keep_their_last_answer_in_every_tick()
        {
            Configure("count", settings =>
            {
                settings.schedule = Schedule.Asynchronous;
                settings.timing = new RoundTiming { period = 0.35f, jitter = 0.1f };
            });
            var nodes = new List<ProbeNode>();
            for (var i = 0; i < 30; i++) nodes.Add(MakeNode(0));
            for (var tick = 1; tick <= 60; tick++)
            {
                Play(1);
                // TryGetAnswer must return the last data that the actuator received.
                foreach (var node in nodes.FindAll(node => node.Actuator.Calls > 0)) Expect(node, node.Actuator.Last.Value, node.Node.AnswerTick);
                if (tick >= 10) Assert.That(nodes.FindAll(node => node.Actuator.Calls == 0), Is.Empty);
            }
            Assert.That(nodes.FindAll(node => node.Node.AnswerTick == Manager.Tick).Count, Is.InRange(0, 15), "only a few nodes may be due");
        }

        [TestCase(Schedule.Lockstep)]
        [TestCase(Schedule.Sequential)]
        [TestCase(Schedule.Asynchronous)]
        public void A_failed_round_keeps_the_last_good_answer(Schedule schedule)
        {
            Configure("trouble", Asynchronous(0.05f) + (settings => settings.schedule = schedule));
            var node = MakeNode(0);
            Play(2);
            var good = node.Answer;
            node.Sensor.Value = 13;
            for (var tick = 0; tick < 4; tick++)
            {
                Play(1);
                Expect(node, good, 2);
            }
            node.Sensor.Value = 0;
            Play(1);
            Assert.That(node.Node.AnswerTick, Is.EqualTo(7));
            Assert.That(node.Node.AnswerInterval, Is.EqualTo(0.05f).Within(1e-6f));
            Expect(node, node.Answer, 7);
        }

        [Test]
        public void A_node_that_rejoins_during_the_actuator_phase_has_no_answer()
        {
            Configure("count");
            var node = MakeNode(0);
            node.Node.RequestedId = 0;
            var other = MakeNode(0);
            Play(2);
            other.Node.Sleep(10);
            Play(3);
            Rejoin(other);
            Assert.That(other.Node.TryGetAnswer(out ActuatorData _), Is.False);
            Assert.That(other.Node.AnswerTick, Is.EqualTo(0));
            var rejoiner = node.Node.gameObject.AddComponent<Rejoiner>();
            rejoiner.Of = other;
            Play(1);
            Assert.That(other.Node.TryGetAnswer(out ActuatorData _), Is.False, "the answer of a departed node must not be returned for a new one");
            Assert.That(other.Actuator.Calls, Is.EqualTo(2));
            rejoiner.Of = null;
            Play(1);
            Expect(other, 1, Manager.Tick);
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_node_that_rejoins_during_the_sensor_phase_has_no_round_in_that_tick()
        {
            Configure("count");
            var node = MakeNode(0);
            var other = MakeNode(0);
            var rejoiner = node.Node.gameObject.AddComponent<RejoiningSensor>();
            var last = node.Node.gameObject.AddComponent<RejoiningSensor>();
            Play(2);
            foreach (var one in new[] { node, other })
            {
                rejoiner.Of = one;
                var calls = (last.Calls, other.Actuator.Calls);
                Play(1);
                Assert.That(Manager.Simulation.DueCount, Is.EqualTo(1));
                Assert.That((last.Calls, other.Actuator.Calls), Is.EqualTo(one == node ? (calls.Item1, calls.Item2 + 1) : (calls.Item1 + 1, calls.Item2)));
                rejoiner.Of = null;
                Play(1);
                Expect(one, 1, Manager.Tick);
            }
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Later_actuators_of_a_node_that_leaves_are_not_called()
        {
            var node = MakeNode(0).Node;
            var rejoiner = node.gameObject.AddComponent<Rejoiner>();
            node.gameObject.AddComponent<Rigidbody>().isKinematic = true;
            node.gameObject.AddComponent<ActuatorTests.Move>();
            var last = node.gameObject.AddComponent<ProbeActuator>();
            Play(2);
            rejoiner.Leaving = node;
            Play(1);
            Assert.That(last.Calls, Is.EqualTo(2));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void A_restarted_simulation_has_no_previous_answers()
        {
            Configure("count", Asynchronous(0.2f));
            var node = MakeNode(0);
            Play(3);
            Assert.That(node.Node.TryGetAnswer(out ActuatorData _), Is.True);
            Manager.enabled = false;
            Assert.That(node.Node.TryGetAnswer(out ActuatorData _), Is.False);
            Manager.enabled = true;
            Assert.That(node.Node.TryGetAnswer(out ActuatorData _), Is.False);
            Play(2);
            Expect(node, 1, 1);
        }

        [Test]
        public void During_the_actuator_phase_later_nodes_have_their_previous_answer()
        {
            Configure("count");
            var first = MakeNode(0);
            var second = MakeNode(0);
            var reader = first.Node.gameObject.AddComponent<AnswerReader>();
            reader.Of = second.Node;
            Play(1);
            Assert.That(reader.Heard, Is.EqualTo(-1));
            Play(1);
            Assert.That(reader.Heard, Is.EqualTo(1));
            second.Node.Sleep(0.1);
            Play(2);
            Assert.That(reader.Heard, Is.EqualTo(2));
        }

        [Test]
        public void Neighbours_of_a_sleeping_node_still_receive_its_last_message()
        {
            Configure("sum");
            var sleeper = MakeNode(7);
            var other = MakeNode(1);
            Manager.AddLink(sleeper.Node.Id, other.Node.Id, directed: true);
            Play(1);
            sleeper.Node.Sleep(10);
            sleeper.Sensor.Value = 100;
            Play(5);
            Assert.That(other.Answer, Is.EqualTo(7));
        }

        [Test]
        public void Sleep_rejects_invalid_times_and_nodes_outside_a_simulation()
        {
            var node = MakeNode(0);
            Assert.Throws<ArgumentOutOfRangeException>(() => node.Node.Sleep(-1));
            Assert.Throws<ArgumentOutOfRangeException>(() => node.Node.Sleep(double.NaN));
            node.Node.enabled = false;
            Assert.Throws<InvalidOperationException>(() => node.Node.Sleep(1));
        }

        [Test]
        public void A_disabled_node_rejoins_without_state_messages_or_script_links()
        {
            Configure("count");
            var listener = MakeNode(0);
            var failing = MakeNode(0);
            failing.Node.RequestedId = failing.Node.Id;
            Manager.AddLink(failing.Node.Id, listener.Node.Id);
            Play(3);
            failing.Node.enabled = false;
            Play(2);
            Assert.That(failing.Answer, Is.EqualTo(3));
            Assert.That(Manager.LinkCount, Is.EqualTo(0));
            failing.Node.enabled = true;
            Play(1);
            Assert.That(failing.Answer, Is.EqualTo(1));
            Assert.That(Manager.LinkCount, Is.EqualTo(0));
            Assert.That(listener.Answer, Is.EqualTo(6));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Messages_in_flight_do_not_reach_a_new_node_with_the_same_id()
        {
            Configure("sum", settings => settings.network.delay = 0.12);
            var sender = MakeNode(5);
            var former = MakeNode(0);
            var id = former.Node.Id;
            Manager.AddLink(sender.Node.Id, id);
            Play(2);
            UnityEngine.Object.Destroy(former.Node.gameObject);
            Play(1);
            var later = MakeNode(0, default, id);
            Play(4);
            Assert.That(later.Answer, Is.EqualTo(0));
            Assert.That(later.Actuator.Last.Heard, Is.EqualTo(0));
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Global_data_reaches_programs_at_the_next_tick()
        {
            Manager.SetGlobals<probe.GlobalData>(data => data.Wind = 1);
            Configure("windy");
            var node = MakeNode(0);
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(-1), "global data of an earlier simulation must be discarded");
            Manager.SetGlobals<probe.GlobalData>(data => data.Wind = 3);
            Manager.SetGlobals<probe.GlobalData>(data => data.Wind = data.Wind + 1);
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(4));
            Play(2);
            Assert.That(node.Answer, Is.EqualTo(4));
            Manager.SetGlobals<probe.GlobalData>(data => data.Wind = data.Wind * 2);
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(8));
            Manager.ReloadPrograms();
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(8), "programs that are loaded again must receive the last data");
        }

        [Test]
        public void Global_data_can_be_set_in_each_frame_of_a_long_pause()
        {
            Configure("windy");
            var node = MakeNode(0);
            Play(1);
            for (var i = 0; i < 200000; i++) Manager.SetGlobals<probe.GlobalData>(data => data.Wind = i);
            Play(1);
            Assert.That(node.Answer, Is.EqualTo(200000));
        }

        [Test]
        public void Global_data_of_another_type_or_with_non_finite_values_stops_the_simulation()
        {
            Configure("windy");
            MakeNode(0);
            Play(1);
            Manager.SetGlobals<probe.GlobalData>(data => data.Wind = float.NaN);
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("not finite").And.StringContaining("wind"));
            Configure("windy");
            Manager.SetGlobals<string>(data => { });
            Play(1);
            Assert.That(Manager.Failure, Is.StringContaining("System.String").And.StringContaining("GlobalData"));
        }

        [Test]
        public void Global_data_of_a_simulation_that_failed_while_writing_it_is_discarded()
        {
            Configure("windy");
            Manager.SetGlobals<probe.GlobalData>(data => data.Wind = 1);
            Manager.SetGlobals<probe.GlobalData>(data => throw new InvalidOperationException("broken writer"));
            Play(1);
            Configure("windy");
            var node = MakeNode(0);
            Manager.SetGlobals<probe.GlobalData>(data => data.Wind = 2);
            Play(2);
            Assert.That((Manager.Failure, node.Answer), Is.EqualTo(("", 2f)));
        }

        private static void Expect(ProbeNode node, float value, ulong tick)
        {
            Assert.That(node.Node.TryGetAnswer(out ActuatorData answer), Is.True);
            Assert.That(answer.Value, Is.EqualTo(value));
            Assert.That(node.Node.AnswerTick, Is.EqualTo(tick));
        }

        internal static Action<SimulationSettings> Asynchronous(float period, float jitter = 0) => settings =>
        {
            settings.schedule = Schedule.Asynchronous;
            settings.timing = new RoundTiming { period = period, phase = 0, jitter = jitter };
        };

        private static ProbeNode MakeTimedNode(RoundTiming timing)
        {
            var timed = MakeNode(0);
            timed.Node.OwnTiming = true;
            timed.Node.Timing.period = timing.period;
            timed.Node.Timing.phase = timing.phase;
            timed.Node.Timing.jitter = timing.jitter;
            Rejoin(timed);
            return timed;
        }

        /// <summary>Lets a node join again, because a node's settings are read when it joins.</summary>
        private static void Rejoin(ProbeNode node)
        {
            node.Node.RequestedId = node.Node.Id;
            node.Node.enabled = false;
            node.Node.enabled = true;
        }

        /// <summary>An actuator that lets another node rejoin.</summary>
        public sealed class Rejoiner : Actuator<ActuatorData>
        {
            public ProbeNode Of;
            public Node Leaving;

            protected override void Act(ActuatorData data)
            {
                if (Of != null) Rejoin(Of);
                if (Leaving != null) Leaving.enabled = false;
            }
        }

        /// <summary>An actuator that changes the times of the simulation.</summary>
        public sealed class TimeChanger : Actuator<ActuatorData>
        {
            public float DeltaTime = 0.1f;
            public float PhysicsStep = 0.02f;

            protected override void Act(ActuatorData data)
            {
                SimulationManager.Current.Settings.deltaTime = DeltaTime;
                SimulationManager.Current.Settings.physicsStep = PhysicsStep;
            }
        }

        /// <summary>A sensor that lets a node rejoin.</summary>
        public sealed class RejoiningSensor : Sensor<SensorData>
        {
            public ProbeNode Of;
            public int Calls;

            protected override void Sense(ref SensorData data)
            {
                Calls++;
                if (Of != null) Rejoin(Of);
            }
        }

        /// <summary>An actuator that reads the answer of another node.</summary>
        public sealed class AnswerReader : Actuator<ActuatorData>
        {
            public Node Of;
            public float Heard;

            protected override void Act(ActuatorData data) => Heard = Of.TryGetAnswer(out ActuatorData answer) ? answer.Value : -1;
        }

        private sealed class SleepingRule : NeighbourhoodRule
        {
            internal double Seconds = 10;

            protected override void FindNeighbours(NeighbourCollector neighbours)
            {
                // Rules also run while the node sleeps.
                if (Seconds > 0) Node.Sleep(Seconds);
                Seconds = 0;
            }
        }

        private sealed class SleepingActuator : Actuator<ActuatorData>
        {
            internal double Seconds;

            protected override void Act(ActuatorData data)
            {
                Node.Sleep(Seconds);
                Seconds = 0;
            }
        }
    }
}
