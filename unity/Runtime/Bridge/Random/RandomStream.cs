using System;

namespace Collektive.Bridge
{
    /// <summary>Purposes of random streams. Streams of different purposes are independent.</summary>
    internal enum RandomPurpose
    {
        /// <summary><c>Device.random</c> of programs (used on the JVM only).</summary>
        Program = 0,
        /// <summary>A node's sensors and actuators.</summary>
        Node = 1,
        /// <summary>The scene, for example for positions of nodes.</summary>
        Scene = 2,
        /// <summary>The times of a node's rounds.</summary>
        Schedule = 3,
        /// <summary>The random walk of a node in the standard scene. The numbers 4 and 5 are in use by the network on the JVM.</summary>
        Movement = 6,
    }

    /// <summary>
    /// Random numbers that depend only on the seed, the node and the purpose, not on the order in which nodes run. Not thread-safe; allocates only when it
    /// is created.
    /// </summary>
    public sealed class RandomStream
    {
        private readonly ulong seed;
        private readonly uint node;
        private readonly uint purpose;
        private ulong block;
        private int used = 4;
        private uint w0, w1, w2, w3;

        /// <summary>Creates the stream of a node (0 or greater; 0 for the scene).</summary>
        internal RandomStream(ulong seed, int node, RandomPurpose purpose)
        {
            if (node < 0) throw new ArgumentOutOfRangeException(nameof(node), node, "a node's id must be 0 or greater");
            this.seed = seed;
            this.node = (uint)node;
            this.purpose = (uint)purpose;
        }

        /// <summary>Returns the next 32 random bits.</summary>
        public uint NextUInt()
        {
            if (used == 4)
            {
                w0 = (uint)block;
                w1 = (uint)(block >> 32);
                w2 = node;
                w3 = purpose;
                Philox.Block(seed, ref w0, ref w1, ref w2, ref w3);
                block++;
                used = 0;
            }
            switch (used++)
            {
                case 0: return w0;
                case 1: return w1;
                case 2: return w2;
                default: return w3;
            }
        }

        /// <summary>Returns a number in [0, 1), uniformly distributed over the multiples of 2^-53.</summary>
        public double NextDouble()
        {
            var high = (ulong)NextUInt();
            var low = NextUInt();
            return ((high << 32 | low) >> 11) * (1.0 / (1L << 53));
        }

        /// <summary>Returns a number from <paramref name="low"/> up to <paramref name="high"/>, which is returned only as a result of rounding.</summary>
        public float Range(float low, float high)
        {
            return (float)(low + ((double)high - low) * NextDouble());
        }

        /// <summary>Returns an integer from <paramref name="low"/> to <paramref name="high"/> - 1.</summary>
        /// <exception cref="ArgumentOutOfRangeException"><paramref name="high"/> is not greater than <paramref name="low"/>.</exception>
        public int Range(int low, int high)
        {
            if (high <= low) throw new ArgumentOutOfRangeException(nameof(high), high, "must be greater than " + low);
            return (int)(low + (long)(NextDouble() * ((long)high - low)));
        }
    }
}
