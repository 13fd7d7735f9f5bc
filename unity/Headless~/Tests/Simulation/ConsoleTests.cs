using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Tests that console messages name their source, and that their number is limited.</summary>
    [TestFixture]
    public sealed class ConsoleTests : SimulationFixture
    {
        [Test]
        public void A_line_printed_by_a_program_names_node_and_program()
        {
            Configure("trouble");
            var id = MakeNode(20).Node.Id;
            Play(3);
            Assert.That(Log, Has.Member("[node " + id + ", program trouble] a line from the program"));
        }

        [Test]
        public void Lines_above_the_rate_limit_are_dropped_and_counted()
        {
            Configure("trouble");
            var node = MakeNode(28);
            Play(1);
            node.Sensor.Value = 0;
            Play(2);
            StopPlaying();
            var shown = Log.FindAll(line => line.Contains("] line ")).Count;
            Assert.That(shown, Is.InRange(1, 3 * HostLog.LinesPerSecond));
            var counted = Log.FindAll(line => line.Contains("lines of the JVM and its programs were skipped"));
            Assert.That(counted.Count, Is.GreaterThanOrEqualTo(1));
            var leftOut = 0;
            foreach (var line in counted) leftOut += int.Parse(line.Substring(0, line.IndexOf(' ')));
            Assert.That(shown + leftOut, Is.EqualTo(1000));
            StartPlaying();
        }

        [Test]
        public void The_same_error_of_many_rounds_is_logged_once_and_counted()
        {
            Configure("trouble");
            var nodes = new List<ProbeNode>();
            for (var i = 0; i < 5; i++) nodes.Add(MakeNode(13));
            Play(5);
            Assert.That(Errors.Count, Is.EqualTo(2));
            Assert.That(Errors[0], Is.StringContaining("round of node 0").And.StringContaining("thirteen"));
            Assert.That(Errors[1], Is.StringContaining("10 rounds of program 'trouble'").And.StringContaining("thirteen"));
            Assert.That(Manager.ErrorCount, Is.EqualTo(25));
            foreach (var node in nodes) Assert.That(node.Node.LastError, Is.StringContaining("thirteen"));
            nodes[0].Sensor.Value = 19;
            Play(1);
            Assert.That(Errors[Errors.Count - 1], Is.StringContaining("view"), "a different error must be logged separately");
            Manager.enabled = false;
            Assert.That(Errors[Errors.Count - 1], Is.StringContaining("29 rounds of program 'trouble'").And.StringContaining("node 4"));
        }
    }
}
