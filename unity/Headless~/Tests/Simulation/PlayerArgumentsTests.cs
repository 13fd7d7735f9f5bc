using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests the command-line options of a built player.</summary>
    [TestFixture]
    public sealed class PlayerArgumentsTests
    {
        private readonly SimulationSettings settings = new SimulationSettings();

        [Test]
        public void Settings_are_parsed_between_Unitys_own_options()
        {
            var problem = PlayerArguments.Apply(settings, new[]
            {
                "Game.x86_64", "-batchmode", "-collektive-seed", "18446744073709551615", "-nographics", "-collektive-record", "out/run 1.clkrec",
                "-collektive-stopAfter", "2.5", "-collektive-threads", "4", "-collektive-schedule", "Sequential", "-collektive-program", "-7",
                "-collektive-jvm.placement", "OwnProcess", "-collektive-jvm.maximumHeapMb", "99",
            });
            Assert.That(problem, Is.Null);
            Assert.That(settings.seed, Is.EqualTo(ulong.MaxValue));
            Assert.That(settings.record, Is.EqualTo("out/run 1.clkrec"));
            Assert.That(settings.stopAfter, Is.EqualTo(2.5f));
            Assert.That(settings.threads, Is.EqualTo(4));
            Assert.That(settings.schedule, Is.EqualTo(Schedule.Sequential));
            Assert.That(settings.program, Is.EqualTo("-7"));
            Assert.That(settings.jvm.settings.placement, Is.EqualTo(JvmPlacement.OwnProcess));
            Assert.That(settings.jvm.settings.maximumHeapMb, Is.EqualTo(99));
        }

        [TestCase("-collektive-sead 7", "-collektive-sead is not an option; the options are: ")]
        [TestCase("-collektive-jars a.jar", "-collektive-jars is not an option")]
        [TestCase("-collektive-jvm.flags -Xint", "-collektive-jvm.flags is not an option")]
        [TestCase("-collektive-jvm.placement Elsewhere", "it must be one of InProcess, OwnProcess")]
        [TestCase("-collektive-jvm.home /jdk", "-collektive-jvm.home needs -collektive-jvm.location Folder")]
        [TestCase("-collektive-seed", "-collektive-seed needs a value")]
        [TestCase("-collektive-seed -1", "-collektive-seed is '-1': it must be a whole number from 0 to 18446744073709551615")]
        [TestCase("-collektive-seed 1e3", "-collektive-seed is '1e3'")]
        [TestCase("-collektive-threads 3000000000", "it must be a whole number")]
        [TestCase("-collektive-deltaTime fast", "it must be a number")]
        [TestCase("-collektive-deltaTime 0,05", "-collektive-deltaTime is '0,05': it must be a number")]
        [TestCase("-collektive-schedule 1", "it must be one of Lockstep, Sequential, Asynchronous")]
        public void Invalid_options_are_reported_with_the_valid_form(string line, string problem) =>
            Assert.That(PlayerArguments.Apply(settings, line.Split(' ')), Is.StringContaining(problem));

        [Test]
        public void An_invalid_option_is_a_problem_of_the_settings()
        {
            settings.ArgumentProblem = "no";
            Assert.That(settings.FindProblem(), Is.EqualTo("no"));
        }
    }
}
