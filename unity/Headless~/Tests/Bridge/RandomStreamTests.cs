using System;
using Collektive.Bridge;
using NUnit.Framework;

namespace Collektive.Headless.Tests.Bridge
{
    [TestFixture]
    public sealed class RandomStreamTests
    {
        // Published test vectors of philox4x32-10. The Kotlin tests use the same vectors.
        [TestCase(0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x0000000000000000ul, 0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u)]
        [TestCase(0xffffffffu, 0xffffffffu, 0xffffffffu, 0xffffffffu, 0xfffffffffffffffful, 0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu)]
        [TestCase(0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u, 0x299f31d0a4093822ul, 0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u)]
        public void Philox_matches_the_published_test_vectors(uint c0, uint c1, uint c2, uint c3, ulong key, uint r0, uint r1, uint r2, uint r3)
        {
            Philox.Block(key, ref c0, ref c1, ref c2, ref c3);
            Assert.That(new[] { c0, c1, c2, c3 }, Is.EqualTo(new[] { r0, r1, r2, r3 }));
        }

        [Test]
        public void A_stream_returns_the_words_of_its_blocks_in_order()
        {
            const ulong seed = 0x0123456789abcdef;
            var stream = new RandomStream(seed, 42, RandomPurpose.Node);
            for (uint block = 0; block < 3; block++)
            {
                uint c0 = block, c1 = 0, c2 = 42, c3 = (uint)RandomPurpose.Node;
                Philox.Block(seed, ref c0, ref c1, ref c2, ref c3);
                foreach (var word in new[] { c0, c1, c2, c3 }) Assert.That(stream.NextUInt(), Is.EqualTo(word));
            }
        }

        [Test]
        public void A_double_uses_two_words_high_word_first()
        {
            var words = new RandomStream(5, 1, RandomPurpose.Scene);
            var doubles = new RandomStream(5, 1, RandomPurpose.Scene);
            for (var i = 0; i < 100; i++)
            {
                var bits = (ulong)words.NextUInt() << 32 | words.NextUInt();
                Assert.That(doubles.NextDouble(), Is.EqualTo((bits >> 11) / (double)(1L << 53)));
            }
        }

        [Test]
        public void Range_is_uniform_and_invalid_arguments_are_rejected()
        {
            var stream = new RandomStream(1, 0, RandomPurpose.Scene);
            var counts = new int[10];
            for (var i = 0; i < 100000; i++) counts[stream.Range(0, 10)]++;
            foreach (var count in counts) Assert.That(count, Is.InRange(9600, 10400));
            Assert.Throws<ArgumentOutOfRangeException>(() => stream.Range(3, 3));
            Assert.Throws<ArgumentOutOfRangeException>(() => new RandomStream(1, -1, RandomPurpose.Node));
        }

        [TestCase(float.MinValue, float.MaxValue)]
        [TestCase(-1e8f, 5f)]
        public void Range_does_not_round_its_width(float low, float high)
        {
            var doubles = new RandomStream(5, 1, RandomPurpose.Scene);
            var floats = new RandomStream(5, 1, RandomPurpose.Scene);
            for (var i = 0; i < 100; i++) Assert.That(floats.Range(low, high), Is.EqualTo((float)(low + ((double)high - low) * doubles.NextDouble())));
        }
    }
}
