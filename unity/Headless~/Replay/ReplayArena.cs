using System;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>The space of the page's first view, in metres.</summary>
    internal sealed class ReplayArena
    {
        private readonly float[] least;
        private readonly float[] greatest;
        // Maximum growth in metres at each end of an axis.
        private readonly float maxGrowth;
        private readonly float[] reachedMin;
        private readonly float[] reachedMax;

        internal ReplayArena(float[] least, float[] greatest, bool grows)
        {
            this.least = least;
            this.greatest = greatest;
            for (var axis = 0; axis < 3; axis++) LongestSide = Math.Max(LongestSide, (double)greatest[axis] - least[axis]);
            maxGrowth = grows ? (float)LongestSide : 0;
            reachedMin = (float[])least.Clone();
            reachedMax = (float[])greatest.Clone();
        }

        /// <summary>Bounds of the arena before it grows.</summary>
        internal double LongestSide { get; }

        /// <summary>The initial arena.</summary>
        internal ReplayArena Copy() => new ReplayArena(least, greatest, maxGrowth > 0);

        /// <summary>Extends the arena to a point, within its limits.</summary>
        internal void Include(float x, float y, float z)
        {
            Include(0, x);
            Include(1, y);
            Include(2, z);
        }

        internal JObject ToJson() =>
            new JObject { ["min"] = ReplayMetadata.Numbers(reachedMin), ["max"] = ReplayMetadata.Numbers(reachedMax) };

        private void Include(int axis, float place)
        {
            if (place < reachedMin[axis]) reachedMin[axis] = Math.Max(place, least[axis] - maxGrowth);
            if (place > reachedMax[axis]) reachedMax[axis] = Math.Min(place, greatest[axis] + maxGrowth);
        }
    }
}
