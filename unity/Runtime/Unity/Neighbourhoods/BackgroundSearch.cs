using System;
using System.Threading;

namespace Collektive.Unity
{
    /// <summary>
    /// A second thread that searches around nodes in a grid, from the last one to the first, while the main thread goes from the first to the last.
    /// The main thread never waits for a search: it takes what is done, and searches itself around the other nodes. The results do not depend
    /// on the thread. Call all members from the main thread.
    /// </summary>
    internal sealed class BackgroundSearch : IDisposable
    {
        /// <summary>For fewer nodes, waking a thread takes longer than the searches.</summary>
        internal const int MinNodes = 128;

        /// <summary>Number of hits, of 12 bytes each, after which the thread stops.</summary>
        private const int MaxHits = 1 << 21;

        private readonly NodeGrid grid;
        private readonly NearNodes found = new NearNodes();
        private readonly SemaphoreSlim work = new SemaphoreSlim(0);
        private readonly ManualResetEventSlim idle = new ManualResetEventSlim(true);
        // By the node's place in the grid: where its hits begin and end.
        private int[] begins = Array.Empty<int>();
        private int[] ends = Array.Empty<int>();
        private Thread thread;
        private Exception error;
        // The main thread has come to this place; the other one has done all from that place on.
        private int requested;
        private int done = int.MaxValue;
        private bool isStopping;

        internal BackgroundSearch(NodeGrid grid) => this.grid = grid;

        /// <summary>Starts searches around the first <paramref name="count"/> nodes. The grid may not change before <see cref="End"/>.</summary>
        internal void Begin(int count)
        {
            if (thread == null)
            {
                isStopping = false;
                thread = new Thread(Work) { IsBackground = true, Name = "Collektive searches" };
                thread.Start();
            }
            if (begins.Length < count)
            {
                begins = new int[Math.Max(count, 2 * begins.Length)];
                ends = new int[begins.Length];
            }
            found.Count = 0;
            requested = 0;
            done = count;
            idle.Reset();
            work.Release();
        }

        /// <summary>Returns the hits near a node if the thread has searched around it. Valid until <see cref="End"/>.</summary>
        internal bool TryTake(int place, out Span<NearNode> near)
        {
            near = default;
            Volatile.Write(ref requested, place);
            if (place < Volatile.Read(ref done)) return false;
            near = new Span<NearNode>(found.Items, begins[place], ends[place] - begins[place]);
            return true;
        }

        /// <summary>Stops the thread, waits for at most one search, and discards the results.</summary>
        /// <exception cref="InvalidOperationException">A search failed; the error is its cause.</exception>
        internal void End()
        {
            Stop();
            if (error == null) return;
            var cause = error;
            error = null;
            throw new InvalidOperationException("the search for neighbours failed on its second thread: " + cause.Message, cause);
        }

        /// <summary>Ends the thread; <see cref="Begin"/> starts another one.</summary>
        public void Dispose()
        {
            if (thread == null) return;
            Stop();
            Volatile.Write(ref isStopping, true);
            work.Release();
            thread.Join();
            thread = null;
        }

        private void Stop()
        {
            Volatile.Write(ref requested, int.MaxValue);
            idle.Wait();
            done = int.MaxValue;
        }

        private void Work()
        {
            while (true)
            {
                work.Wait();
                if (Volatile.Read(ref isStopping)) return;
                try
                {
                    Search();
                }
                catch (Exception exception)
                {
                    // An exception of this thread would end the process.
                    error = exception;
                }
                idle.Set();
            }
        }

        private void Search()
        {
            for (var place = done - 1; place > Volatile.Read(ref requested) && found.Count < MaxHits; place--)
            {
                begins[place] = found.Count;
                grid.SearchAround(place, found);
                ends[place] = found.Count;
                Volatile.Write(ref done, place);
            }
        }
    }
}
