using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;

namespace Collektive.Headless.Tests.Components
{
    [TestFixture]
    public sealed class RoundTimerTests
    {
        private const double Tick = 0.05;

        [TestCase(0.1f, 0f, new[] { 0, 2, 4, 6, 8, 10 })]
        [TestCase(0.1f, 0.05f, new[] { 1, 3, 5, 7, 9, 11 })]
        [TestCase(0.05f, 0f, new[] { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 })]
        [TestCase(0.13f, 0f, new[] { 0, 3, 6, 8, 11 })]
        [TestCase(0.2f, 0.3f, new[] { 6, 10 })]
        public void Rounds_start_at_the_phase_and_repeat_every_period(float period, float phase, int[] expected)
        {
            Assert.That(DueTicks(Make(period, phase, 0, 1), 12), Is.EqualTo(expected));
        }

        [Test]
        public void The_phase_of_a_late_node_starts_when_it_joins()
        {
            var timer = new RoundTimer(new RoundTiming { period = 0.1f, phase = 0.05f }, Stream(1), 5 * Tick);
            Assert.That(DueTicks(timer, 12), Is.EqualTo(new[] { 6, 8, 10 }));
        }

        [Test]
        public void A_negative_phase_is_random_within_the_period()
        {
            var first = new HashSet<int>();
            for (var node = 0; node < 200; node++) first.Add(DueTicks(Make(0.5f, -1, 0, node), 20)[0]);
            Assert.That(first.Count, Is.EqualTo(10), "ticks 1 to 10");
            Assert.That(DueTicks(Make(0.5f, -1, 0, 7), 100), Is.EqualTo(DueTicks(Make(0.5f, -1, 0, 7), 100)));
        }

        [Test]
        public void Jitter_delays_each_round_independently_and_does_not_accumulate()
        {
            const int rounds = 400;
            var ticks = DueTicks(Make(0.5f, 0, 0.4f, 3), rounds * 10);
            Assert.That(ticks.Count, Is.EqualTo(rounds));
            var later = new HashSet<int>();
            for (var k = 0; k < rounds; k++)
            {
                Assert.That(ticks[k] - 10 * k, Is.InRange(0, 8), "round " + k);
                later.Add(ticks[k] - 10 * k);
            }
            Assert.That(later.Count, Is.EqualTo(8), "from 0.05 s to 0.4 s later");
        }

        [Test]
        public void Rounds_missed_in_a_pause_count_as_one_and_do_not_shift_later_rounds()
        {
            var asked = Make(0.13f, 0, 0.1f, 3);
            var slept = Make(0.13f, 0, 0.1f, 3);
            DueTicks(asked, 100);
            Assert.That(slept.TakeDue(99 * Tick + 1e-6), Is.True);
            for (var tick = 100; tick < 200; tick++)
            {
                Assert.That(slept.TakeDue(tick * Tick + 1e-6), Is.EqualTo(asked.TakeDue(tick * Tick + 1e-6)), "tick " + tick);
            }
        }

        [TestCase(0f, 0f, 0f, "period is 0 s")]
        [TestCase(float.NaN, 0f, 0f, "period is NaN s")]
        [TestCase(float.PositiveInfinity, 0f, 0f, "period is")]
        [TestCase(-1f, 0f, 0f, "period is -1 s")]
        [TestCase(0.049f, 0f, 0f, "period is 0.049 s: it must be finite and at least the delta time, 0.05 s")]
        [TestCase(0.1f, float.NaN, 0f, "phase is NaN s")]
        [TestCase(0.1f, float.PositiveInfinity, 0f, "phase is")]
        [TestCase(0.1f, 0f, 0.1f, "jitter is 0.1 s")]
        [TestCase(0.1f, 0f, -0.1f, "jitter is -0.1 s")]
        [TestCase(0.1f, 0f, float.NaN, "jitter is NaN s")]
        public void Values_out_of_range_are_reported(float period, float phase, float jitter, string expected)
        {
            Assert.That(new RoundTiming { period = period, phase = phase, jitter = jitter }.FindProblem(0.05f), Is.StringStarting(expected));
        }

        [Test]
        public void The_delta_time_is_a_valid_period()
        {
            Assert.That(new RoundTiming { period = 0.05f }.FindProblem(0.05f), Is.Null);
        }

        private static RoundTimer Make(float period, float phase, float jitter, int node) =>
            new RoundTimer(new RoundTiming { period = period, phase = phase, jitter = jitter }, Stream(node), 0);

        private static RandomStream Stream(int node) => new RandomStream(1, node, RandomPurpose.Schedule);

        private static List<int> DueTicks(RoundTimer timer, int ticks)
        {
            var due = new List<int>();
            for (var tick = 0; tick < ticks; tick++)
            {
                if (timer.TakeDue(tick * Tick + 1e-6)) due.Add(tick);
            }
            return due;
        }
    }
}
