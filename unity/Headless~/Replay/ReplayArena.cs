using System;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>The space of the page's first view, in metres.</summary>
    internal sealed class ReplayArena
    {
        private readonly float[] minimum;
        private readonly float[] maximum;
        // Maximum growth in metres at each end of an axis.
        private readonly float maxGrowth;
        private readonly float[] reachedMin;
        private readonly float[] reachedMax;

        internal ReplayArena(float[] minimum, float[] maximum, bool grows)
        {
            this.minimum = minimum;
            this.maximum = maximum;
            for (var axis = 0; axis < 3; axis++)
            {
                LongestSide = Math.Max(LongestSide, (double)maximum[axis] - minimum[axis]);
                Farthest = Math.Max(Farthest, Math.Max(Math.Abs((double)minimum[axis]), Math.Abs((double)maximum[axis])));
            }
            maxGrowth = grows ? (float)LongestSide : 0;
            reachedMin = (float[])minimum.Clone();
            reachedMax = (float[])maximum.Clone();
        }

        /// <summary>Longest side of the arena before it grows, in metres.</summary>
        internal double LongestSide { get; }

        /// <summary>Largest absolute coordinate of the arena before it grows, in metres.</summary>
        internal double Farthest { get; }

        /// <summary>Returns a copy of the arena as it was before it grew.</summary>
        internal ReplayArena Copy() => new ReplayArena(minimum, maximum, maxGrowth > 0);

        /// <summary>Extends the arena to a point, within its limits.</summary>
        internal void Include(float x, float y, float z)
        {
            Include(0, x);
            Include(1, y);
            Include(2, z);
        }

        internal JObject ToJson() =>
            new JObject { ["min"] = ReplayMetadata.Numbers(reachedMin), ["max"] = ReplayMetadata.Numbers(reachedMax) };

        private void Include(int axis, float coordinate)
        {
            if (coordinate < reachedMin[axis]) reachedMin[axis] = Math.Max(coordinate, minimum[axis] - maxGrowth);
            if (coordinate > reachedMax[axis]) reachedMax[axis] = Math.Min(coordinate, maximum[axis] + maxGrowth);
        }
    }
}
