using System;
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

        [Test]
        public void An_expression_can_be_disposed_twice_and_cannot_be_evaluated_afterwards()
        {
            var expression = new PlaceExpression("id + time + x + y + z", 1000);
            Assert.That(expression.Evaluate(1, 20, 300, 4000, 50000), Is.EqualTo(54321));
            expression.Dispose();
            expression.Dispose();
            Assert.Throws<ObjectDisposedException>(() => expression.Evaluate(1, 2, 3, 4, 5));
        }
    }
}
