using System;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>A moving shape that is not a node, with its pose in each frame.</summary>
    public sealed class ReplayMover
    {
        private readonly JObject shape;
        private readonly JArray poses = new JArray();

        internal ReplayMover(JObject shape) => this.shape = shape;

        /// <summary>Adds the pose of the next frame, with a position in metres and a unit quaternion. Call it once for each frame.</summary>
        public void Add(float x, float y, float z, float rotationX, float rotationY, float rotationZ, float rotationW)
        {
            // Thousandths are precise enough for display, and need few characters.
            foreach (var number in new[] { x, y, z, rotationX, rotationY, rotationZ, rotationW }) poses.Add(Math.Round(ReplayMetadata.Number(number), 3));
        }

        /// <summary>Adds a frame in which the shape does not exist.</summary>
        public void AddMissing() => Add(0, 0, 0, 0, 0, 0, 0);

        /// <summary>Returns the poses added so far, and removes them.</summary>
        internal JArray TakePoses()
        {
            var result = new JArray(poses);
            poses.Clear();
            return result;
        }

        internal JObject ToJson() => new JObject { ["shape"] = shape, ["poses"] = poses };
    }
}
