using System;
using System.Linq;
using Collektive.Bridge;
using NUnit.Framework;
using org.collektive.schema;

namespace Collektive.Headless.Tests.Schema
{
    [TestFixture]
    public class MirrorLayoutTests
    {
        [Test]
        public void AMirrorOfAnotherSizeOrOffsetIsRejected()
        {
            var mirror = default(Vector3Value);
            MirrorLayout.Size<Vector3Value>(12);
            MirrorLayout.Offset(ref mirror, ref mirror.Z, 8);
            Assert.That(
                Assert.Throws<InvalidOperationException>(() => MirrorLayout.Size<Vector3Value>(16)).Message,
                Is.StringContaining("Vector3Value has 12 bytes, not 16"));
            Assert.Throws<InvalidOperationException>(() =>
            {
                var other = default(Vector3Value);
                MirrorLayout.Offset(ref other, ref other.Z, 4);
            });
        }

        [Test]
        public void ASchemaHasItsNameAndTypeFingerprints()
        {
            var schema = new test.globals.GlobalsSchema();
            Assert.That(schema.Name, Is.EqualTo("test.globals.GlobalsSchema"));
            Assert.That(schema.Types.Select(t => t.Key), Is.EqualTo(new[] { "SensorData", "ActuatorData", "GlobalData" }));
            Assert.That(schema.Types[0].Value, Is.EqualTo(schema.Types[1].Value), "equal structs");
            Assert.That(schema.Types[0].Value, Is.Not.EqualTo(schema.Types[2].Value));
        }
    }
}
