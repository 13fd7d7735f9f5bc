using System;
using System.Diagnostics;
using System.IO;
using System.Threading;
using Collektive.Bridge;
using NUnit.Framework;
using probe;

namespace Collektive.Headless.Tests
{
    /// <summary>Tests flight recordings during a session. The JDK's tool jfr reads them.</summary>
    [TestFixture]
    public sealed class JvmRecordingTests
    {
        private string folder;

        [SetUp]
        public void StartJvm()
        {
            TestJvm.Start();
            folder = Path.Combine(Path.GetTempPath(), "collektive-recording-" + Guid.NewGuid().ToString("N"));
        }

        [TearDown]
        public void RemoveFiles()
        {
            if (Directory.Exists(folder)) Directory.Delete(folder, true);
        }

        [Test]
        public void The_first_start_does_not_stall_a_tick()
        {
            using (var session = TestJvm.Open("double"))
            {
                TickUntil(session, () => false, 2000);
                var usual = TickUntil(session, () => false, 2000);
                JvmRecording.Start(Path.Combine(folder, "first.jfr"));
                var during = TickUntil(session, () => Jvm.GetStatus().Recording == RecordingState.On, int.MaxValue);
                var start = Jvm.GetStatus().RecordingMs;
                JvmRecording.Stop();
                TickUntil(session, () => Jvm.GetStatus().Recording == RecordingState.Off, int.MaxValue);
                var stop = Jvm.GetStatus().RecordingMs;
                Console.WriteLine(
                    "  recording: started in " + start + " ms, written in " + stop + " ms; longest tick " + during.ToString("0.0") +
                    " ms meanwhile, " + usual.ToString("0.0") + " ms before");
                // The first recording of a JVM takes some hundred milliseconds to start, and later ones take only a few.
                if (start >= 200) Assert.That(during, Is.LessThan(start / 2.0));
            }
        }

        /// <summary>Runs ticks until a condition holds, and returns the duration of the longest tick in milliseconds.</summary>
        private static double TickUntil(Session session, Func<bool> done, int ticks)
        {
            var longest = 0.0;
            var clock = new Stopwatch();
            for (var i = 0; i < ticks && !done(); i++)
            {
                clock.Restart();
                TestJvm.Tick(session);
                longest = Math.Max(longest, clock.Elapsed.TotalMilliseconds);
            }
            return longest;
        }

        [Test]
        public void A_recording_started_between_ticks_contains_each_later_tick()
        {
            var file = Path.Combine(folder, "play.jfr");
            using (var session = TestJvm.Open("double"))
            {
                TestJvm.Tick(session);
                JvmRecording.Start(file, JvmRecording.Profile);
                WaitFor(RecordingState.On);
                for (var i = 0; i < 40; i++) TestJvm.Tick(session);
                JvmRecording.Dump(Path.Combine(folder, "dump.jfr"));
                WaitFor(RecordingState.On);
                for (var i = 0; i < 10; i++) TestJvm.Tick(session);
            }
            JvmRecording.Stop();
            var status = WaitFor(RecordingState.Off);
            Assert.That(status.RecordingError, Is.Empty);
            Assert.That(status.RecordingPath, Is.EqualTo(file));
            Assert.That(Count(Jfr("summary", file), "collektive.Tick"), Is.EqualTo(50));
            Assert.That(Count(Jfr("summary", file), "collektive.SessionEnd"), Is.EqualTo(1));
            Assert.That(Count(Jfr("summary", Path.Combine(folder, "dump.jfr")), "collektive.Tick"), Is.EqualTo(40));
            var text = Jfr("print --events collektive.Tick", file);
            Assert.That(text, Is.StringContaining("dueNodes = 1"));
            Assert.That(text, Is.StringContaining("bytesIn = "));
        }

        [Test]
        public void Recording_errors_report_the_reason()
        {
            JvmRecording.Start(Path.Combine(folder, "a.jfr"), "fastest");
            Assert.That(WaitFor(RecordingState.Off).RecordingError, Is.StringContaining("unknown settings 'fastest'"));
            JvmRecording.Stop();
            Assert.That(WaitFor(RecordingState.Off).RecordingError, Is.StringContaining("no recording is running"));
            Assert.Throws<ArgumentException>(() => JvmRecording.Start(" "));
        }

        private static JvmStatus WaitFor(RecordingState state)
        {
            var clock = Stopwatch.StartNew();
            while (true)
            {
                var status = Jvm.GetStatus();
                if (status.Recording == state) return status;
                Assert.That(clock.Elapsed.TotalSeconds, Is.LessThan(60), "the recording is still " + status.Recording);
                Thread.Sleep(5);
            }
        }

        private static int Count(string summary, string name)
        {
            foreach (var line in summary.Split('\n'))
            {
                var words = line.Split(new[] { ' ' }, StringSplitOptions.RemoveEmptyEntries);
                if (words.Length > 1 && words[0] == name) return int.Parse(words[1]);
            }
            return 0;
        }

        private static string Jfr(string command, string file)
        {
            var start = new ProcessStartInfo(TestJvm.Home + "/bin/jfr", command + " " + file) { RedirectStandardOutput = true, UseShellExecute = false };
            using (var process = Process.Start(start))
            {
                var text = process.StandardOutput.ReadToEnd();
                process.WaitForExit();
                Assert.That(process.ExitCode, Is.EqualTo(0), text);
                return text;
            }
        }
    }
}
