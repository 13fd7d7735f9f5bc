using System;
using System.Diagnostics;
using System.Threading;
using Collektive.Bridge;
using NUnit.Framework;

namespace Collektive.Headless.Tests
{
    /// <summary>Tests that each session loads its programs again, and that closing a session unloads them.</summary>
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
        public void A_hundred_reloads_do_not_leak_classes_or_metaspace()
        {
            for (var i = 0; i < 10; i++) Play();
            var before = StatusAfterCollection();
            var clock = Stopwatch.StartNew();
            for (var i = 0; i < 100; i++) Play();
            Console.WriteLine("  a reload with three ticks: " + (clock.Elapsed.TotalMilliseconds / 100).ToString("0.0") + " ms");
            var after = StatusAfterCollection();
            using (TestJvm.Open("sum"))
            {
                Assert.That(StatusAfterCollection().Classes - after.Classes, Is.GreaterThan(3), "the count must include the classes of one session");
            }
            Assert.That(after.Classes - before.Classes, Is.LessThan(100), "classes: " + before.Classes + " -> " + after.Classes);
            Assert.That(after.MetaspaceUsed - before.MetaspaceUsed, Is.LessThan(Mebi), "metaspace: " + before.MetaspaceUsed + " -> " + after.MetaspaceUsed);
        }

        /// <summary>
        /// Returns the status after several garbage collections, because the threads of a closed session keep its classes for some milliseconds.
        /// </summary>
        private static JvmStatus StatusAfterCollection()
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
