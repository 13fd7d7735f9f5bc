using System;

namespace Collektive.Unity
{
    /// <summary>What is known of the lines between pairs of nodes in one tick: how many obstacles of some layers are on each.</summary>
    internal sealed class SightLines
    {
        /// <summary>Nobody has looked yet.</summary>
        internal const int Unknown = -1;

        // A hash table with open addressing; lines of earlier ticks count as free places.
        private Line[] lines = new Line[256];
        private int count;
        private int tick = 1;

        private struct Line
        {
            internal int Low;
            internal int High;
            internal int Layers;
            internal int Tick;
            internal int Obstacles;
        }

        /// <summary>Forgets what was known: a tick begins.</summary>
        internal void Clear()
        {
            tick++;
            count = 0;
        }

        /// <summary>The obstacles between two nodes, for the caller to fill in when they are <see cref="Unknown"/>; valid until the next call.</summary>
        internal ref int Between(int a, int b, int layers)
        {
            if (2 * count >= lines.Length) Grow();
            ref var line = ref Find(Math.Min(a, b), Math.Max(a, b), layers);
            if (line.Tick != tick)
            {
                count++;
                line = new Line { Low = Math.Min(a, b), High = Math.Max(a, b), Layers = layers, Tick = tick, Obstacles = Unknown };
            }
            return ref line.Obstacles;
        }

        private ref Line Find(int low, int high, int layers)
        {
            var all = lines;
            var place = Hash(low, high, layers) & all.Length - 1;
            for (; ; place = place + 1 & all.Length - 1)
            {
                ref var line = ref all[place];
                if (line.Tick != tick || line.Low == low && line.High == high && line.Layers == layers) return ref line;
            }
        }

        private static int Hash(int low, int high, int layers)
        {
            var mixed = unchecked((uint)low * 0x9E3779B1u ^ (uint)high * 0x85EBCA77u ^ (uint)layers * 0xC2B2AE3Du);
            return unchecked((int)(mixed ^ mixed >> 15));
        }

        private void Grow()
        {
            var old = lines;
            lines = new Line[2 * old.Length];
            foreach (var line in old)
            {
                if (line.Tick == tick) Find(line.Low, line.High, line.Layers) = line;
            }
        }
    }
}
