using System;
using System.Collections.Generic;
using System.Text;

namespace Collektive.Fuzz
{
    /// <summary>Inputs derived from a corpus by changing bytes, and by removing, duplicating, exchanging and replacing parts.</summary>
    internal sealed class Mutations
    {
        private static readonly string[] JsonTokens =
        {
            "null", "true", "-1", "0", "1e999", "-0", "1e-400", "NaN", "Infinity", "18446744073709551616", "9223372036854775807", "0x7", "{}", "[]", "[[[[",
            "{\"a\":", "\"\"", "\"\\u0000\"", "\"\\ud800\"", "\"..\"", "\"/\"", "\"0\"", "//", "/*", "\uFEFF", ",", ":", "\"$type\"", "new Date(1)",
            "\"2020-01-01T00:00:00Z\"", "\"scenario\":{}", "\"version\":1",
        };

        private readonly Random random;
        private readonly List<byte[]> corpus;

        /// <param name="corpus">May grow between the calls of <see cref="Next"/>.</param>
        internal Mutations(int seed, List<byte[]> corpus)
        {
            random = new Random(seed);
            this.corpus = corpus;
        }

        internal byte[] Next()
        {
            var bytes = new List<byte>(corpus[random.Next(corpus.Count)]);
            for (var i = random.Next(1, 5); i > 0; i--) Change(bytes);
            return bytes.ToArray();
        }

        private void Change(List<byte> bytes)
        {
            var at = random.Next(bytes.Count + 1);
            var length = Math.Min(bytes.Count - at, random.Next(1, 40));
            switch (random.Next(7))
            {
                case 0:
                    if (at < bytes.Count) bytes[at] ^= (byte)(1 << random.Next(8));
                    break;
                case 1:
                    bytes.RemoveRange(at, length);
                    break;
                case 2:
                    bytes.InsertRange(at, bytes.GetRange(at, length));
                    break;
                case 3:
                    bytes.RemoveRange(at, length);
                    bytes.InsertRange(at, RandomToken());
                    break;
                case 4:
                    bytes.InsertRange(at, RandomToken());
                    break;
                case 5:
                    var other = corpus[random.Next(corpus.Count)];
                    var from = random.Next(other.Length + 1);
                    bytes.RemoveRange(at, bytes.Count - at);
                    bytes.AddRange(new ArraySegment<byte>(other, from, other.Length - from));
                    break;
                case 6:
                    if (random.Next(20) > 0) break;
                    // Deep nesting, which is a separate risk.
                    bytes.InsertRange(at, Encoding.ASCII.GetBytes(new string(random.Next(2) == 0 ? '[' : '{', random.Next(100000))));
                    break;
            }
            if (bytes.Count > 300000) bytes.RemoveRange(300000, bytes.Count - 300000);
        }

        private byte[] RandomToken() => Encoding.UTF8.GetBytes(JsonTokens[random.Next(JsonTokens.Length)]);
    }
}
