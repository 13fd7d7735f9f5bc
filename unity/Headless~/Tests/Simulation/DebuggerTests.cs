using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Net;
using System.Net.Sockets;
using System.Threading;
using Collektive.Bridge;
using Collektive.Unity;
using Collektive.Unity.Editor;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>
    /// Tests that the editor continues while a debugger (jdb) has stopped the JVM at a breakpoint. These tests run in a separate process, because the JVM
    /// needs a debug port.
    /// </summary>
    [TestFixture, Category("Debugger")]
    public sealed class DebuggerTests : SimulationFixture
    {
        private const int LimitMs = 30000;
        private const int StepLimitMs = 500;

        private static readonly int Port = FreePort();

        [SetUp]
        public void StartWithDebugPort()
        {
            Loop.IsBatchMode = false;
            Configure("sum", settings =>
            {
                settings.jvm.settings.debugPort = Port;
                settings.stepLimitMs = StepLimitMs;
                settings.threads = 1; // so that only one round at a time is at the breakpoint
            });
        }

        [TearDown]
        public void RestoreBatchMode() => Loop.IsBatchMode = true;

        [TestCase("stop in")]
        [TestCase("stop thread in")]
        public void Frames_go_on_at_a_breakpoint_and_the_results_are_the_same(string stop)
        {
            MakeRow();
            var expected = 0UL;
            Manager.Ticked += manager =>
            {
                if (manager.Tick == 30) expected = manager.Digest;
            };
            Play(30);
            // On a busy machine, the session opens after the first frames.
            Await(() => expected != 0);
            RestartPlay();
            MakeRow();
            var digest = 0UL;
            Manager.Ticked += manager =>
            {
                if (manager.Tick == 30) digest = manager.Digest;
            };
            Play(3);
            using (var debugger = new Jdb(Port))
            {
                Stop(debugger, stop);
                var tick = Manager.Tick;
                var frame = Time.frameCount;
                Await(() => Log.Contains("JVM stopped by the debugger in tick " + (tick + 1) + ": continue the program there"));
                var held = Stopwatch.StartNew();
                while (held.ElapsedMilliseconds < 3 * StepLimitMs) Frame();
                Assert.That(Time.frameCount - frame, Is.GreaterThan(30));
                Assert.That(Manager.Tick, Is.EqualTo(tick));
                Assert.That(Dashboard.State(Manager), Is.EqualTo("JVM stopped by the debugger"));
                Assert.That(Jvm.TryGetStatus(), Is.Null);
                debugger.Continue();
                Await(() => digest != 0);
            }
            Assert.That(Errors, Is.Empty);
            Assert.That(digest, Is.EqualTo(expected));
            Await(() => Dashboard.State(Manager) == "running");
        }

        [Test]
        public void Changes_while_the_JVM_is_stopped_take_effect_at_the_next_tick()
        {
            var nodes = MakeRow();
            Play(3);
            using (var debugger = new Jdb(Port))
            {
                Stop(debugger, "stop in");
                var tick = Manager.Tick;
                var calls = nodes[2].Actuator.Calls;
                Assert.That(nodes[1].Answer, Is.EqualTo(2));
                UnityEngine.Object.Destroy(nodes[0].Node.gameObject);
                nodes[3].Node.gameObject.SetActive(false);
                nodes[3].Node.gameObject.SetActive(true);
                MakeNode(100, Vector3.right * 3);
                Manager.AddLink(1, 3);
                Manager.Settings.deltaTime = 0.1f;
                Manager.Paused = true;
                for (var i = 0; i < 5; i++) Manager.Step();
                Frame();
                Assert.That(Manager.Tick, Is.EqualTo(tick));
                debugger.Continue();
                Await(() => Manager.Tick == tick + 1);
                Assert.That(Manager.SimulatedTime, Is.EqualTo((tick + 1) * 0.05).Within(1e-6));
                Assert.That(nodes[2].Actuator.Calls, Is.EqualTo(calls + 1));
                Manager.Step();
                Await(() => Manager.Tick == tick + 2);
            }
            Assert.That(Errors, Is.Empty);
            Assert.That(Manager.Nodes.Count, Is.EqualTo(4));
        }

        [Test]
        public void Play_can_end_while_the_JVM_is_stopped()
        {
            MakeRow();
            Play(3);
            using (var debugger = new Jdb(Port))
            {
                Stop(debugger, "stop in");
                var clock = Stopwatch.StartNew();
                Loop.Quit();
                Assert.That(clock.ElapsedMilliseconds, Is.LessThan(2000));
                Assert.That(Log.Any(line => line.Contains("was not completed, because the JVM is stopped in a debugger")), Is.True);
                Assert.That(Errors, Is.Empty);
                RestartPlay();
                MakeRow();
                Play(1);
                Assert.That(Manager.Failure, Is.StringContaining("a debugger has stopped the JVM; continue the program"));
                debugger.Continue();
                AwaitJvm();
                RestartPlay();
                MakeRow();
                Await(() => Manager.Tick >= 5);
            }
            Assert.That(ShimCounts.Sessions, Is.EqualTo(1));
        }

        [Test]
        public void A_debugger_that_detaches_lets_the_tick_end_and_the_limit_counts_again()
        {
            MakeRow();
            Play(3);
            using (var debugger = new Jdb(Port))
            {
                Stop(debugger, "stop in");
                var held = Stopwatch.StartNew();
                while (held.ElapsedMilliseconds < 3 * StepLimitMs) Frame();
            }
            Await(() => !Manager.Simulation.IsPending);
            Play(5);
            Assert.That(Errors, Is.Empty);
        }

        [TestCase("stop in")]
        [TestCase("stop thread in")]
        public void Frames_go_on_at_a_breakpoint_in_the_opening(string stop)
        {
            MakeRow();
            Play(3);
            RestartPlay();
            MakeRow();
            using (var debugger = new Jdb(Port, "org.collektive.host.Host.open"))
            {
                Stop(debugger, stop);
                var frame = Time.frameCount;
                Await(() => Log.Contains("JVM stopped by the debugger in the opening of the session: continue the program there"));
                Assert.That(Time.frameCount - frame, Is.GreaterThan(30));
                Assert.That(Manager.Tick, Is.EqualTo(0));
                Assert.That(Dashboard.State(Manager), Is.EqualTo("JVM stopped by the debugger"));
                debugger.Continue();
                Await(() => Manager.Tick >= 5);
            }
            Assert.That(Errors, Is.Empty);
        }

        [Test]
        public void Play_can_end_at_a_breakpoint_in_the_opening()
        {
            MakeRow();
            Play(3);
            RestartPlay();
            MakeRow();
            using (var debugger = new Jdb(Port, "org.collektive.host.Host.open"))
            {
                Stop(debugger, "stop in");
                var clock = Stopwatch.StartNew();
                StopPlaying();
                Assert.That(clock.ElapsedMilliseconds, Is.LessThan(2000));
                Assert.That(Log.Any(line => line.StartsWith("the opening of the session was not completed")), Is.True);
                debugger.Continue();
                AwaitJvm();
                RestartPlay();
                MakeRow();
                Await(() => Manager.Tick >= 5);
            }
            Assert.That(Errors, Is.Empty);
            Assert.That(ShimCounts.Sessions, Is.EqualTo(1));
        }

        [Test]
        public void A_batch_run_waits_in_the_tick()
        {
            MakeRow();
            Play(3);
            Loop.IsBatchMode = true;
            using (var debugger = new Jdb(Port))
            {
                debugger.Break("stop in");
                debugger.ContinueAtBreakpoint(3 * StepLimitMs);
                var clock = Stopwatch.StartNew();
                while (clock.ElapsedMilliseconds < LimitMs && Manager.Times.Step < 3 * StepLimitMs)
                {
                    var tick = Manager.Tick;
                    Play(1);
                    Assert.That(Manager.Tick, Is.EqualTo(tick + 1));
                }
                Assert.That(Manager.Times.Step, Is.GreaterThan(3 * StepLimitMs - 100));
            }
            Assert.That(Errors, Is.Empty);
        }

        private static ProbeNode[] MakeRow()
        {
            var nodes = new ProbeNode[4];
            for (var i = 0; i < nodes.Length; i++)
            {
                nodes[i] = MakeNode(i, Vector3.right * i, i);
                nodes[i].Node.gameObject.AddComponent<RadiusNeighbourhood>().Radius = 1.5f;
            }
            return nodes;
        }

        private void RestartPlay()
        {
            StopPlaying();
            StartPlaying();
            StartWithDebugPort();
        }

        private static void AwaitJvm()
        {
            var clock = Stopwatch.StartNew();
            while (Jvm.TryGetStatus() == null && clock.ElapsedMilliseconds < LimitMs) Thread.Sleep(20);
        }

        /// <summary>Plays until the JVM has stopped at the breakpoint.</summary>
        private void Stop(Jdb debugger, string command)
        {
            debugger.Break(command);
            Await(() => debugger.HasPrinted("Breakpoint hit") && Manager.Simulation.IsPending);
        }

        private void Frame()
        {
            Play(1);
            Thread.Sleep(10);
        }

        private void Await(Func<bool> condition)
        {
            var clock = Stopwatch.StartNew();
            while (!condition() && clock.ElapsedMilliseconds < LimitMs && Manager.Failure.Length == 0) Frame();
            Assert.That(condition(), Is.True, "tick " + Manager.Tick + " " + Dashboard.State(Manager));
        }

        private static int FreePort()
        {
            var listener = new TcpListener(IPAddress.Loopback, 0);
            listener.Start();
            var port = ((IPEndPoint)listener.LocalEndpoint).Port;
            listener.Stop();
            return port;
        }

        /// <summary>The debugger of the JDK, with a breakpoint in the probe program `sum` or in another method.</summary>
        private sealed class Jdb : IDisposable
        {
            private readonly Process process;
            private readonly string place;
            private readonly List<string> output = new List<string>();
            private string stop = "";
            private volatile bool isContinued;
            private bool isClosed;

            internal Jdb(int port, string place = "probe.ProbeKt.sum")
            {
                this.place = place;
                process = Process.Start(new ProcessStartInfo(TestJvm.Home + "/bin/jdb", "-attach 127.0.0.1:" + port)
                {
                    UseShellExecute = false, RedirectStandardInput = true, RedirectStandardOutput = true,
                });
                process.OutputDataReceived += (sender, line) =>
                {
                    lock (output) output.Add(line.Data ?? "");
                    if (isContinued && line.Data != null && line.Data.Contains("Breakpoint hit")) Resume();
                };
                process.BeginOutputReadLine();
            }

            /// <summary>Sets the breakpoint. The JVM reaches it soon afterwards.</summary>
            internal void Break(string command)
            {
                stop = command;
                Send(command + " " + place);
                AwaitLine("breakpoint " + place);
            }

            internal void Continue()
            {
                AwaitLine("Breakpoint hit");
                // This flag is needed because jdb clears only one of the breakpoints if classes of earlier sessions are still loaded.
                isContinued = true;
                Send("clear " + place);
                Resume();
            }

            private void Resume() => Send(stop == "stop in" ? "cont" : "resume");

            internal void ContinueAtBreakpoint(int afterMs) => new Thread(() =>
            {
                AwaitLine("Breakpoint hit");
                Thread.Sleep(afterMs);
                Continue();
            }).Start();

            internal bool HasPrinted(string part)
            {
                lock (output) return output.Any(line => line.Contains(part));
            }

            public void Dispose()
            {
                lock (process)
                {
                    isClosed = true;
                    process.StandardInput.Close();
                }
                if (!process.WaitForExit(LimitMs)) process.Kill();
                process.Dispose();
            }

            private void Send(string command)
            {
                lock (process)
                {
                    if (isClosed) return;
                    process.StandardInput.WriteLine(command);
                    process.StandardInput.Flush();
                }
            }

            private void AwaitLine(string part)
            {
                var clock = Stopwatch.StartNew();
                while (clock.ElapsedMilliseconds < LimitMs)
                {
                    if (HasPrinted(part)) return;
                    Thread.Sleep(10);
                }
                lock (output) throw new TimeoutException("jdb did not print '" + part + "' but: " + string.Join("\n", output));
            }
        }
    }
}
