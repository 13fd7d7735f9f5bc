using System;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests a built player that runs with -batchmode. The player of the stand-in for Unity always does.</summary>
    [TestFixture]
    public sealed class BatchPlayerTests : SimulationFixture
    {
        [TearDown]
        public void ReturnToEditor() => Loop.IsEditor = true;

        [Test]
        public void Each_frame_runs_one_tick_and_the_process_quits_after_the_run()
        {
            EnterPlayer(1);
            MakeNode(2);
            for (var frame = 0; frame < 20; frame++)
            {
                Assert.That(Loop.QuitRequested, Is.False);
                Loop.Frame(0.001f);
                Assert.That(Manager.Tick, Is.EqualTo(frame + 1));
            }
            Assert.That(Manager.Finished, Is.True);
            Assert.That(Loop.QuitRequested, Is.True);
            Assert.That(Loop.ExitCode, Is.EqualTo(0));
        }

        [TestCase(0.5f)]
        [TestCase(60f)]
        public void Each_frame_runs_one_tick_even_if_ticks_are_long(float deltaTime)
        {
            Loop.IsEditor = false;
            Configure("double", settings =>
            {
                settings.deltaTime = deltaTime;
                settings.stopAfter = 3 * deltaTime;
            });
            MakeNode(2);
            for (var frame = 0; frame < 3; frame++) Loop.Frame(0.001f);
            Assert.That(Manager.Tick, Is.EqualTo(3));
            Assert.That(Loop.QuitRequested, Is.True);
        }

        [Test]
        public void The_exit_code_is_1_after_errors()
        {
            EnterPlayer(0.1f);
            MakeNode(2);
            Manager.Ticked += _ => throw new InvalidOperationException("no");
            for (var frame = 0; frame < 2; frame++) Loop.Frame(1);
            Assert.That(Loop.QuitRequested, Is.True);
            Assert.That(Loop.ExitCode, Is.EqualTo(1));
        }

        [Test]
        public void The_exit_code_is_1_if_the_simulation_cannot_start()
        {
            EnterPlayer(1, "no such program");
            MakeNode(2);
            Loop.Frame(1);
            Assert.That(Errors, Is.Not.Empty);
            Assert.That(Loop.QuitRequested, Is.True);
            Assert.That(Loop.ExitCode, Is.EqualTo(1));
        }

        [Test]
        public void A_run_without_an_end_follows_the_clock()
        {
            EnterPlayer(0);
            MakeNode(2);
            Loop.Frame(0.15f);
            Assert.That(Manager.Tick, Is.EqualTo(3));
            Assert.That(Loop.QuitRequested, Is.False);
        }

        private void EnterPlayer(float stopAfter, string program = "double")
        {
            Loop.IsEditor = false;
            Configure(program, settings => settings.stopAfter = stopAfter);
        }
    }
}
