using System;
using Collektive.Unity;
using NUnit.Framework;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests that exceptions in handlers affect neither the tick nor the simulation.</summary>
    public sealed class TickHandlersTests : SimulationFixture
    {
        [Test]
        public void A_throwing_handler_is_reported_by_name_and_the_others_continue()
        {
            var calls = 0;
            MakeNode(1);
            Manager.Ticked += ThrowOnPurpose;
            Manager.Ticked += _ => calls++;
            Play(1);
            Assert.That(Errors, Is.EqualTo(new[] { "InvalidOperationException: TickHandlersTests.ThrowOnPurpose failed after tick 1: broken on purpose" }));
            Assert.That(Manager.ErrorCount, Is.EqualTo(1));
            Assert.That((Manager.Errors[0].Source, Manager.Errors[0].Node, Manager.Errors[0].LastTick),
                Is.EqualTo(("TickHandlersTests.ThrowOnPurpose", NodeErrors.NoNode, 1UL)));
            Assert.That((Manager.Tick, calls, Manager.Failure), Is.EqualTo((1UL, 1, "")));
        }

        [Test]
        public void A_handler_that_keeps_throwing_is_removed()
        {
            MakeNode(1);
            Manager.Ticked += manager =>
            {
                if (manager.Tick != 2) throw new InvalidOperationException("broken on purpose");
            };
            Play(11);
            Assert.That(Errors, Has.None.Contains("in a row"), "the failures are not in a row, because tick 2 succeeded");
            Play(5);
            Assert.That(Errors[Errors.Count - 1], Is.EqualTo(
                "TickHandlersTests.A_handler_that_keeps_throwing_is_removed (lambda) failed 10 times in a row and was removed from Ticked: "
                + "fix it, then add it again"));
            Assert.That(Manager.ErrorCount, Is.EqualTo(11));
            Assert.That(Manager.Tick, Is.EqualTo(16));
        }

        [Test]
        public void A_handler_can_remove_itself()
        {
            var calls = 0;
            MakeNode(1);
            void Once(SimulationManager manager)
            {
                calls++;
                manager.Ticked -= Once;
            }
            Manager.Ticked += Once;
            Play(3);
            Assert.That(calls, Is.EqualTo(1));
        }

        [Test]
        public void A_throwing_stop_condition_is_reported_and_does_not_stop_the_run()
        {
            MakeNode(1);
            Manager.StopCondition = manager => throw new InvalidOperationException("broken on purpose");
            Play(2);
            Assert.That(Manager.ErrorCount, Is.EqualTo(2));
            Assert.That(Errors[0], Is.StringContaining(
                "TickHandlersTests.A_throwing_stop_condition_is_reported_and_does_not_stop_the_run (lambda) failed after tick 1"));
            Assert.That(Manager.Finished, Is.False);
        }

        private void ThrowOnPurpose(SimulationManager manager) => throw new InvalidOperationException("broken on purpose");
    }
}
