using System;
using System.Diagnostics;
using System.Threading;
using Collektive.Bridge;
using NUnit.Framework;

namespace Collektive.Headless.Tests
{
    /// <summary>Each session loads its programs anew; what an ended one loaded goes.</summary>
    [TestFixture]
    [Category("Slow")]
    public sealed class ReloadTests
    {
        private const long Mebi = 1 << 20;

        [SetUp]
        public void StartJvm()
        {
            TestJvm.Start();
        }

        [Test]
        public void A_hundred_reloads_leave_classes_and_metaspace_as_they_were()
        {
            for (var i = 0; i < 10; i++) Play();
            var before = Settled();
            var clock = Stopwatch.StartNew();
            for (var i = 0; i < 100; i++) Play();
            Console.WriteLine("  a reload with three ticks: " + (clock.Elapsed.TotalMilliseconds / 100).ToString("0.0") + " ms");
            var after = Settled();
            using (TestJvm.Open("sum"))
            {
                Assert.That(Settled().Classes - after.Classes, Is.GreaterThan(3), "the count sees the classes of one session");
            }
            Assert.That(after.Classes - before.Classes, Is.LessThan(100), "classes: " + before.Classes + " -> " + after.Classes);
            Assert.That(after.MetaspaceUsed - before.MetaspaceUsed, Is.LessThan(Mebi), "metaspace: " + before.MetaspaceUsed + " -> " + after.MetaspaceUsed);
        }

        /// <summary>The threads of a session that was closed just now hold its classes for some milliseconds.</summary>
        private static JvmStatus Settled()
        {
            for (var i = 0; i < 3; i++)
            {
                Thread.Sleep(50);
                Jvm.GetStatus(collect: true);
            }
            return Jvm.GetStatus(collect: true);
        }

        private static void Play()
        {
            using (var session = TestJvm.Open("sum"))
            {
                for (var i = 0; i < 3; i++) TestJvm.Tick(session);
            }
        }
    }
}
