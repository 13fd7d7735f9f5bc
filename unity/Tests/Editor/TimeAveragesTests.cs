using NUnit.Framework;

namespace Collektive.Unity.Editor.Tests
{
    public sealed class TimeAveragesTests
    {
        [Test]
        public void Averages_are_zero_before_the_first_tick()
        {
            Assert.That(new TimeAverages().Of(times => times.Step), Is.EqualTo((0.0, 0.0)));
        }

        [Test]
        public void Mean_and_maximum_cover_the_last_hundred_ticks()
        {
            var averages = new TimeAverages();
            averages.Add(new TickTimes(1000, 1000, 1000, 1000, 1000, 1000), 1000);
            for (var i = 0; i < TimeAverages.Ticks; i++) averages.Add(new TickTimes(0, 1, 0, i % 2 == 0 ? 2 : 4, 0, 0), 0.5);
            Assert.That(averages.Count, Is.EqualTo(100));
            Assert.That(averages.Of(times => times.Step), Is.EqualTo((3.0, 4.0)));
            Assert.That(averages.Of(times => times.Total), Is.EqualTo((4.0, 5.0)));
            Assert.That(averages.Rounds, Is.EqualTo((0.5, 0.5)));
        }
    }
}
