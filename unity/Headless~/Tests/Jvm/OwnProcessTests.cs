using System.Diagnostics;
using System.Linq;
using System.Threading;
using Collektive.Bridge;
using NUnit.Framework;

namespace Collektive.Headless.Tests
{
    /// <summary>Tests that a JVM in a separate process may end at any time, and that it can be replaced. These tests run only in that placement.</summary>
    [TestFixture, Category("OwnProcess")]
    public sealed class OwnProcessTests
    {
        [SetUp]
        public void StartJvm()
        {
            TestJvm.Start();
        }

        [Test]
        public void A_killed_JVM_ends_the_session_and_can_be_restarted()
        {
            var before = Jvm.Process;
            using (var session = TestJvm.Open("sum"))
            {
                TestJvm.Tick(session);
                Process.GetProcessById(before).Kill();
                var error = Assert.Throws<BridgeException>(() => TestJvm.Tick(session));
                Assert.That(error.Error, Is.EqualTo(BridgeError.JvmLost));
                Assert.That(error.Message, Is.StringContaining("signal 9").And.StringContaining("start it again"));
            }
            Assert.That(Jvm.State, Is.EqualTo(JvmState.Lost));
            Assert.That(Jvm.TryGetStatus(), Is.Null);
            TestJvm.Start();
            Assert.That(Jvm.Process, Is.Not.EqualTo(before));
            using (var session = TestJvm.Open("sum")) TestJvm.Tick(session);
        }

        [Test]
        public void Changed_settings_take_effect_at_the_next_start_without_sessions()
        {
            var settings = TestJvm.Settings;
            settings.maximumHeapMb = 99;
            using (TestJvm.Open("sum"))
            {
                Assert.That(
                    Assert.Throws<BridgeException>(() => Jvm.Start(TestJvm.Launch(settings))).Error, Is.EqualTo(BridgeError.JvmRunning));
            }
            Jvm.Start(TestJvm.Launch(settings));
            Assert.That(Jvm.GetStatus().Options, Has.Some.EqualTo("-Xmx99m"));
            TestJvm.Start();
            Assert.That(Jvm.GetStatus().Options, Has.None.EqualTo("-Xmx99m"));
        }

        [Test]
        public void The_status_contains_the_process_id_and_uptime()
        {
            Thread.Sleep(20);
            var status = Jvm.GetStatus();
            Assert.That(status.Process, Is.EqualTo(Jvm.Process));
            Assert.That(Process.GetProcesses().Any(process => process.Id == status.Process), Is.True);
            Assert.That(status.Uptime.TotalMilliseconds, Is.InRange(20, 3600000));
        }

        [Test]
        public void A_stopped_JVM_is_replaced()
        {
            Jvm.Stop(5000);
            Assert.That(Jvm.State, Is.EqualTo(JvmState.Stopped));
            TestJvm.Start();
            using (var session = TestJvm.Open("sum")) TestJvm.Tick(session);
        }
    }
}
