using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>A set of ids, stored as ranges. Ids that were assigned in order form only a few ranges.</summary>
    internal sealed class IdRanges
    {
        // The bounds of the ranges, in ascending order. Ranges without a gap between them are merged.
        private readonly List<int> first = new List<int>();
        private readonly List<int> last = new List<int>();

        internal void Add(int id)
        {
            // The first range that ends at or after the id.
            var index = last.BinarySearch(id);
            if (index < 0) index = ~index;
            if (index < first.Count && first[index] <= id) return;
            var continues = index > 0 && last[index - 1] == id - 1;
            var precedes = index < first.Count && first[index] == id + 1;
            if (continues && precedes)
            {
                last[index - 1] = last[index];
                first.RemoveAt(index);
                last.RemoveAt(index);
            }
            else if (continues) last[index - 1] = id;
            else if (precedes) first[index] = id;
            else
            {
                first.Insert(index, id);
                last.Insert(index, id);
            }
        }

        /// <summary>Returns the first and the last id of each range.</summary>
        internal JArray ToJson()
        {
            var json = new JArray();
            for (var range = 0; range < first.Count; range++)
            {
                json.Add(first[range]);
                json.Add(last[range]);
            }
            return json;
        }
    }
}
