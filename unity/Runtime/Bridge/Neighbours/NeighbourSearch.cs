using System;
using System.Collections.Generic;

namespace Collektive.Bridge
{
    /// <summary>
    /// Finds nearby nodes, and stores all directed links of a scene with their reference counts. The implementation is in C (<c>collektive_neighbours.h</c>).
    /// A link exists while at least one rule or script references it. The native memory is allocated on first use. Results are spans of this memory and
    /// are valid until the next call.
    /// </summary>
    internal sealed unsafe class NeighbourSearch : IDisposable
    {
        /// <summary>Number of a rule that was not added.</summary>
        internal const int NoRule = -1;

        // Error codes of the native functions, from clk_neighbours_error.
        private const int MemoryCode = -2;
        private const int NotFiniteCode = -3;

        private IntPtr native;

        ~NeighbourSearch() => Dispose();

        /// <summary>All pairs for views, including unused pairs.</summary>
        internal Span<LinkPair> Pairs
        {
            get
            {
                var all = All;
                return new Span<LinkPair>(all.Pairs, all.Count);
            }
        }

        /// <summary>Number of pairs that fit in the native memory.</summary>
        internal int PairCapacity => All.Capacity;

        /// <summary>Number of directed links.</summary>
        internal int Count => All.Links;

        private Shim.LinkPairs All
        {
            get
            {
                Shim.LinkPairs all = default;
                if (native != IntPtr.Zero) Shim.clk_neighbours_pairs(native, &all);
                return all;
            }
        }

        private IntPtr Native
        {
            get
            {
                if (native != IntPtr.Zero) return native;
                ShimLibrary.Check();
                native = Shim.clk_neighbours_create();
                return native != IntPtr.Zero ? native : throw OutOfMemory();
            }
        }

        /// <summary>
        /// Replaces the points, which must be sorted by id. <paramref name="cell"/> is the side length of the grid's cells in metres; 0 selects the mean
        /// radius of the last searches.
        /// </summary>
        /// <returns>False if a coordinate is not finite.</returns>
        internal bool TryPlace(Span<NodePoint> points, float cell = 0)
        {
            fixed (NodePoint* first = points)
            {
                var code = Shim.clk_neighbours_place(Native, first, points.Length, cell);
                if (code == NotFiniteCode) return false;
                Check(code);
                return true;
            }
        }

        /// <summary>Returns the points within <paramref name="radius"/> metres of a position, sorted by id.</summary>
        internal Span<NearPoint> Within(float x, float y, float z, float radius)
        {
            if (native == IntPtr.Zero) return default;
            NearPoint* found;
            var count = Check(Shim.clk_neighbours_within(native, x, y, z, 0, radius, &found));
            return new Span<NearPoint>(found, count);
        }

        /// <summary>
        /// Returns at most <paramref name="limit"/> points nearest to a position, sorted by distance and then by id. <paramref name="guess"/> is an
        /// estimate of the radius that contains them; 0 for none.
        /// </summary>
        internal Span<NearPoint> Nearest(float x, float y, float z, int limit, float guess)
        {
            if (native == IntPtr.Zero || limit < 1) return default;
            NearPoint* found;
            var count = Check(Shim.clk_neighbours_nearest(native, x, y, z, limit, guess, &found));
            return new Span<NearPoint>(found, count);
        }

        /// <summary>Adds a rule without links and returns its number.</summary>
        internal int AddRule() => Check(Shim.clk_neighbours_add_rule(Native));

        /// <summary>Removes a rule and its references. Does nothing for <see cref="NoRule"/>.</summary>
        internal void RemoveRule(int rule)
        {
            if (native != IntPtr.Zero) Shim.clk_neighbours_remove_rule(native, rule);
        }

        /// <summary>Runs searches, and replaces the links of the rules that requested them.</summary>
        /// <returns>
        /// The number of searches. If the links exceed <paramref name="maxLinks"/>, the number of searches up to and including the one that exceeded it.
        /// </returns>
        internal int Update(Span<RuleSearch> searches, int threads, int maxLinks)
        {
            fixed (RuleSearch* first = searches) return Check(Shim.clk_neighbours_update(Native, first, searches.Length, threads, maxLinks));
        }

        /// <summary>Replaces the links of a rule. If several neighbours have the same id, only the first is used.</summary>
        internal void Take(int rule, int centre, Span<RuleNeighbour> list, float tolerance, bool bothWays)
        {
            fixed (RuleNeighbour* first = list) Check(Shim.clk_neighbours_take(Native, rule, centre, first, list.Length, tolerance, bothWays ? 1 : 0));
        }

        /// <summary>Adds a reference for scripts to a link. A link has at most one such reference.</summary>
        internal void Hold(LinkRecord link) => Check(Shim.clk_neighbours_hold(Native, &link));

        /// <summary>Releases the reference that scripts have to a link.</summary>
        /// <returns>False if no script added the link.</returns>
        internal bool Release(int from, int to) => native != IntPtr.Zero && Check(Shim.clk_neighbours_release(native, from, to)) != 0;

        /// <summary>Returns whether a link exists.</summary>
        internal bool Has(int from, int to) => native != IntPtr.Zero && Shim.clk_neighbours_has(native, from, to) != 0;

        /// <summary>Replaces a list's content with all links.</summary>
        internal void CopyTo(List<LinkRecord> target)
        {
            target.Clear();
            foreach (ref var pair in Pairs)
            {
                if (pair.Up.References > 0) target.Add(pair.Up.Record(pair.Low, pair.High));
                if (pair.Down.References > 0) target.Add(pair.Down.Record(pair.High, pair.Low));
            }
        }

        /// <summary>Sets whether the JVM knows a node. Links are sent only once the JVM knows both of their nodes.</summary>
        internal void Know(int id, bool known)
        {
            if (known || native != IntPtr.Zero) Check(Shim.clk_neighbours_know(Native, id, known ? 1 : 0));
        }

        /// <summary>Removes all links of nodes that left. The JVM removes its copies together with the nodes.</summary>
        internal void Drop(Span<int> ids)
        {
            if (native == IntPtr.Zero) return;
            fixed (int* first = ids) Check(Shim.clk_neighbours_drop(native, first, ids.Length));
        }

        /// <summary>Writes the links that changed since the last call to the request.</summary>
        internal void Flush(StepRequest request)
        {
            if (native == IntPtr.Zero) return;
            Shim.LinkChanges changes;
            Check(Shim.clk_neighbours_flush(native, &changes));
            request.Links.AddAll(new ReadOnlySpan<LinkRecord>(changes.Set, changes.SetCount));
            request.LinksRemoved.AddAll(new ReadOnlySpan<LinkEnds>(changes.Removed, changes.RemovedCount));
        }

        /// <summary>Frees the native memory with all points and links. A later call allocates memory again.</summary>
        public void Dispose()
        {
            if (native != IntPtr.Zero) Shim.clk_neighbours_destroy(native);
            native = IntPtr.Zero;
        }

        private static int Check(int code)
        {
            if (code >= 0) return code;
            throw code == MemoryCode ? OutOfMemory()
                : new BridgeException(BridgeError.Argument, "the neighbour search rejected an argument (code " + code + "): report an issue");
        }

        private static BridgeException OutOfMemory() =>
            new BridgeException(BridgeError.Memory, "not enough memory for the neighbour search: use smaller neighbourhoods or fewer nodes");
    }
}
