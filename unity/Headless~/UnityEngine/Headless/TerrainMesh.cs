namespace UnityEngine.Headless
{
    /// Converts a height map to triangles.
    public static class TerrainMesh
    {
        /// Returns every `step`-th sample along both sides, row by row, as points relative to the object.
        public static Vector3[] Points(TerrainData data, int step)
        {
            var side = (data.heightmapResolution - 1) / step + 1;
            var distance = data.heightmapScale;
            var points = new Vector3[side * side];
            for (var row = 0; row < side; row++)
                for (var column = 0; column < side; column++)
                    points[side * row + column] = new Vector3(step * column * distance.x, data.GetHeight(step * column, step * row), step * row * distance.z);
            return points;
        }

        /// Returns the triangles of a grid with this number of points along each side.
        public static int[] Triangles(int side)
        {
            var triangles = new int[6 * (side - 1) * (side - 1)];
            var next = 0;
            for (var row = 0; row < side - 1; row++)
                for (var column = 0; column < side - 1; column++)
                {
                    var corner = side * row + column;
                    foreach (var point in new[] { corner, corner + side, corner + 1, corner + 1, corner + side, corner + side + 1 }) triangles[next++] = point;
                }
            return triangles;
        }
    }
}
