using System;
using Collektive.Bridge;
using Collektive.FlatBuffers;
using NUnit.Framework;
using test.blocks;

namespace Collektive.Headless.Tests.Schema
{
    [TestFixture]
    public class ActuatorBufferTests
    {
        private ActuatorBuffer<ActuatorData> actuators;
        private byte[] frame;
        private int position;

        [SetUp]
        public void MakeFrame()
        {
            actuators = (ActuatorBuffer<ActuatorData>)new BlocksSchema().CreateActuators();
            var writer = new StructSensorBuffer<ActuatorData>(8);
            writer.EnsureCapacity(3);
            for (var i = 0; i < 3; i++) writer.Items[i].Target.X = i;
            var builder = new FlatBufferBuilder(64);
            var offset = writer.Write(builder, 3);
            builder.Finish(offset);
            frame = builder.SizedByteArray();
            position = frame.Length - offset;
        }

        [Test]
        public void ElementsMatchTheFrame()
        {
            actuators.Attach(new ByteBuffer(frame), position);
            Assert.That(actuators.Count, Is.EqualTo(3));
            Assert.That(actuators[2].Target.X, Is.EqualTo(2f));
            Assert.That(actuators.DataType, Is.EqualTo(typeof(ActuatorData)));
        }

        [TestCase(-1)]
        [TestCase(3)]
        public void AnIndexOutOfRangeThrows(int index)
        {
            actuators.Attach(new ByteBuffer(frame), position);
            Assert.Throws<ArgumentOutOfRangeException>(() => { var _ = actuators[index]; });
        }

        [Test]
        public void ATruncatedFrameIsRejectedAndThePreviousOneIsKept()
        {
            actuators.Attach(new ByteBuffer(frame), position);
            for (var length = 1; length < frame.Length; length++)
            {
                var cut = new byte[length];
                Array.Copy(frame, cut, length);
                var error = Assert.Throws<BridgeException>(() => actuators.Attach(new ByteBuffer(cut), position));
                Assert.That(error.Error, Is.EqualTo(BridgeError.Frame));
            }
            Assert.That(actuators.Count, Is.EqualTo(3));
            Assert.That(actuators[1].Target.X, Is.EqualTo(1f));
        }

        [Test]
        public void PreviousElementsAreReadableForOneFrameAndCopiesIndefinitely()
        {
            actuators.Attach(new ByteBuffer(frame), position);
            AnswerCopy kept = null;
            Assert.Throws<ArgumentOutOfRangeException>(() => actuators.Previous(0), "no previous frame");
            NextFrame(10);
            Assert.That(actuators[2].Target.X, Is.EqualTo(12));
            Assert.That(actuators.Previous(2).Target.X, Is.EqualTo(2));
            actuators.CopyPrevious(2, ref kept);
            NextFrame(20);
            Assert.That(actuators.Previous(2).Target.X, Is.EqualTo(12));
            Assert.That(((AnswerCopy<ActuatorData>)kept).Value.Target.X, Is.EqualTo(2));
            Assert.Throws<ArgumentOutOfRangeException>(() => actuators.CopyPrevious(3, ref kept));
        }

        /// <summary>Writes the next frame to the same memory, as a session does.</summary>
        private void NextFrame(float first)
        {
            actuators.Retain();
            var writer = new StructSensorBuffer<ActuatorData>(8);
            writer.EnsureCapacity(3);
            for (var i = 0; i < 3; i++) writer.Items[i].Target.X = first + i;
            var builder = new FlatBufferBuilder(64);
            builder.Finish(writer.Write(builder, 3));
            builder.SizedByteArray().CopyTo(frame, 0);
            actuators.Attach(new ByteBuffer(frame), position);
        }

        [TestCase(-1)]
        [TestCase(int.MaxValue)]
        public void APositionOutsideTheFrameIsRejected(int outside)
        {
            Assert.Throws<BridgeException>(() => actuators.Attach(new ByteBuffer(frame), outside));
        }
    }
}
