using NUnit.Framework;

namespace Collektive.Headless.Tests.Player
{
    public sealed class PlaceExpressionTests
    {
        [TestCase(":x")]
        [TestCase("20 + $x")]
        [TestCase("@time")]
        public void Parameters_are_rejected(string text)
        {
            var error = Assert.Throws<ScenarioException>(() => new PlaceExpression(text, 1000));
            Assert.That(error.Message, Is.EqualTo("it must not have parameters"));
        }
    }
}
