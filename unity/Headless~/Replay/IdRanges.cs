using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>A set of ids as ranges. Ids that are assigned in order form few ranges.</summary>
    internal sealed class IdRanges
    {
        // The ranges in ascending order, with a gap between two ranges.
        private readonly List<int> first = new List<int>();
        private readonly List<int> last = new List<int>();

        internal void Add(int id)
        {
            // Returns the first range that ends at or after the id.
            var place = last.BinarySearch(id);
            if (place < 0) place = ~place;
            if (place < first.Count && first[place] <= id) return;
            var continues = place > 0 && last[place - 1] == id - 1;
            var precedes = place < first.Count && first[place] == id + 1;
            if (continues && precedes)
            {
                last[place - 1] = last[place];
                first.RemoveAt(place);
                last.RemoveAt(place);
            }
            else if (continues) last[place - 1] = id;
            else if (precedes) first[place] = id;
            else
            {
                first.Insert(place, id);
                last.Insert(place, id);
            }
        }

        /// <summary>First and last id of each range.</summary>
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
