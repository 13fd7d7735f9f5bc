using System.Collections.Generic;

namespace Collektive.Headless
{
    /// <summary>Values over time, from a CSV file with the column value and optionally id and time. Without ids, the values apply to all nodes.</summary>
    public sealed class ValueSeries
    {
        private const int AllNodes = -1;

        private readonly Dictionary<int, List<double[]>> byId = new Dictionary<int, List<double[]>>();

        /// <summary>Reads a file.</summary>
        /// <exception cref="ScenarioException">The file is invalid.</exception>
        public ValueSeries(DataFile file)
        {
            foreach (var row in file.ReadCsv("value", "id", "time"))
            {
                var line = (int)row[3];
                if (double.IsNaN(row[0])) throw file.Error(1, "the column 'value' is missing");
                var id = double.IsNaN(row[1]) ? AllNodes : (int)row[1];
                if (!double.IsNaN(row[1]) && (id < 0 || id != row[1])) throw file.Error(line, "'id' must be a whole number of at least 0");
                if (!byId.TryGetValue(id, out var rows)) byId[id] = rows = new List<double[]>();
                if (rows.Count > 0 && !(row[2] > rows[rows.Count - 1][2]))
                    throw file.Error(line, "the time must be after that of line " + rows[rows.Count - 1][3] + ", or the id must differ");
                rows.Add(row);
            }
        }

        /// <summary>Returns the last value of a node up to a time; NaN before its first value, and for nodes that are not in the file.</summary>
        public double ValueAt(int id, double time)
        {
            if (!byId.TryGetValue(id, out var rows) && !byId.TryGetValue(AllNodes, out rows)) return double.NaN;
            int low = 0, high = rows.Count;
            while (low < high)
            {
                var middle = (low + high) / 2;
                // The time of a value without a time is NaN, so it applies from the start.
                if (rows[middle][2] > time) high = middle;
                else low = middle + 1;
            }
            return low == 0 ? double.NaN : rows[low - 1][0];
        }
    }
}
