using System;

namespace UnityEngine
{
    /// A height map. It is not drawn.
    public sealed class TerrainData : Object
    {
        const int MinResolution = 33, MaxResolution = 4097;

        float[,] heights = new float[MinResolution, MinResolution]; // by z and x, relative to the size
        Vector3 ownSize = new Vector3(MinResolution - 1, 600f, MinResolution - 1);

        /// Number of changes.
        internal int Version { get; private set; }

        /// Number of changes of all terrains. Colliders check their terrains when it increases.
        internal static int Changes { get; private set; }

        /// Number of samples along each side, a power of two plus one from 33 to 4097. Other numbers are rounded up. Setting the resolution resets all
        /// heights to 0. As in Unity, it keeps the distance between samples, and so changes the size.
        public int heightmapResolution
        {
            get => this.Existing().heights.GetLength(0);
            set
            {
                var resolution = MinResolution;
                while (resolution < value && resolution < MaxResolution) resolution = 2 * resolution - 1;
                var distance = heightmapScale;
                heights = new float[resolution, resolution];
                ownSize = new Vector3(distance.x * (resolution - 1), ownSize.y, distance.z * (resolution - 1));
                Changed();
            }
        }

        /// Metres between samples along x and z, and the maximum height in metres as y.
        public Vector3 heightmapScale => new Vector3(ownSize.x / (heightmapResolution - 1), ownSize.y, ownSize.z / (heightmapResolution - 1));

        public Vector3 size
        {
            get => this.Existing().ownSize;
            set
            {
                ThrowIfDestroyed();
                ownSize = value;
                Changed();
            }
        }

        public float GetHeight(int x, int y) => ownSize.y * heights[Inside(y), Inside(x)];

        /// Sets a block of heights. `heights` has a row for each sample along z.
        public void SetHeights(int xBase, int yBase, float[,] heights)
        {
            int rows = heights.GetLength(0), columns = heights.GetLength(1);
            if (xBase < 0 || yBase < 0 || xBase + columns > heightmapResolution || yBase + rows > heightmapResolution)
                throw new ArgumentException("The heights are outside the height map, which has " + heightmapResolution + " samples along each side.");
            for (var row = 0; row < rows; row++)
                for (var column = 0; column < columns; column++) this.heights[yBase + row, xBase + column] = Mathf.Clamp01(heights[row, column]);
            Changed();
        }

        public float[,] GetHeights(int xBase, int yBase, int width, int height)
        {
            ThrowIfDestroyed();
            var part = new float[height, width];
            for (var row = 0; row < height; row++)
                for (var column = 0; column < width; column++) part[row, column] = heights[yBase + row, xBase + column];
            return part;
        }

        void Changed()
        {
            Version++;
            Changes++;
        }

        int Inside(int index) => Math.Max(0, Math.Min(heightmapResolution - 1, index));
    }
}
