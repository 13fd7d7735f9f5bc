using System;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>The poses of a moving shape that is not a node, by frame.</summary>
    public sealed class ReplayMover
    {
        private readonly JObject shape;
        private readonly JArray poses = new JArray();

        internal ReplayMover(JObject shape) => this.shape = shape;

        /// <summary>Adds the pose of the next frame: metres, and a unit quaternion. Call it once for each frame.</summary>
        public void Add(float x, float y, float z, float rotationX, float rotationY, float rotationZ, float rotationW)
        {
            // Rounded to thousandths, which are precise enough for display and short.
            foreach (var number in new[] { x, y, z, rotationX, rotationY, rotationZ, rotationW }) poses.Add(Math.Round(ReplayMetadata.Number(number), 3));
        }

        /// <summary>Returns and removes the poses so far.</summary>
        internal JArray TakePoses()
        {
            var taken = new JArray(poses);
            poses.Clear();
            return taken;
        }

        internal JObject ToJson() => new JObject { ["shape"] = shape, ["poses"] = poses };
    }
}
