using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Unity;
using NUnit.Framework;

namespace Collektive.Headless.Tests.Components
{
    /// <summary>Compares the table with a dictionary under random references, releases, departures and flushes.</summary>
    [TestFixture]
    public sealed class LinkTableTests
    {
        private const int Nodes = 12;

        [TestCase(1)]
        [TestCase(2)]
        [TestCase(3)]
        [TestCase(4)]
        public void A_link_exists_while_it_is_referenced_and_each_change_is_sent_once(int seed)
        {
            var random = new RandomStream((ulong)seed, 0, RandomPurpose.Scene);
            var table = new LinkTable();
            var holds = new List<(int From, int To, LinkHandle Handle)>();
            var model = new Dictionary<(int, int), int>();
            var engine = new HashSet<(int, int)>();
            var known = new PagedArray<bool>();
            for (var i = 0; i < Nodes; i++) known[i] = i % 3 != 0;
            for (var step = 0; step < 5000; step++)
            {
                var from = random.Range(0, Nodes);
                var to = random.Range(0, Nodes);
                switch (random.Range(0, 10))
                {
                    case 0:
                    case 1:
                    case 2:
                    case 3:
                        holds.Add((from, to, table.AddReference(from, to, false, 1, 0)));
                        model[(from, to)] = model.TryGetValue((from, to), out var count) ? count + 1 : 1;
                        break;
                    case 4:
                    case 5:
                    case 6:
                    case 7:
                        if (holds.Count == 0) break;
                        var index = random.Range(0, holds.Count);
                        var hold = holds[index];
                        holds.RemoveAt(index);
                        table.Release(hold.Handle);
                        Release(model, (hold.From, hold.To));
                        break;
                    case 8:
                        var gone = new PagedArray<bool>();
                        gone[from] = true;
                        table.DropLinksOf(gone);
                        // References to dropped links are stale: releasing them must have no effect. The engine drops its links too.
                        holds.ForEach(h => { if (h.From == from || h.To == from) table.Release(h.Handle); });
                        holds.RemoveAll(h => h.From == from || h.To == from);
                        RemoveAll(model, from);
                        engine.RemoveWhere(link => link.Item1 == from || link.Item2 == from);
                        break;
                    default:
                        known[from] = true;
                        Flush(table, engine, known);
                        break;
                }
                Assert.That(table.Count, Is.EqualTo(model.Count), "step " + step);
                Assert.That(table.Contains(from, to), Is.EqualTo(model.ContainsKey((from, to))), "step " + step);
            }
            for (var i = 0; i < Nodes; i++) known[i] = true;
            Flush(table, engine, known);
            Assert.That(engine, Is.EquivalentTo(model.Keys));
        }

        [Test]
        public void Changed_values_are_sent_once()
        {
            var table = new LinkTable();
            var handle = table.AddReference(0, 1, false, 10, 0);
            var known = new PagedArray<bool> { [0] = true, [1] = true };
            Assert.That(Sent(table, known), Is.EqualTo(1));
            Assert.That(Sent(table, known), Is.EqualTo(0));
            table.Update(handle, 12, 0);
            Assert.That(Sent(table, known), Is.EqualTo(1));
            table.Update(handle, 12, 0);
            Assert.That(Sent(table, known), Is.EqualTo(0));
            Assert.That(table.IsAlive(handle), Is.True);
            table.Release(handle);
            Assert.That(table.IsAlive(handle), Is.False);
        }

        [Test]
        public void Scripts_hold_one_reference_to_each_of_1000_links()
        {
            var table = new LinkTable();
            for (var turn = 0; turn < 2; turn++)
            {
                for (var i = 0; i < 1000; i++) table.AddScriptReference(i, i + 1, 1, 0);
                Assert.That(table.Count, Is.EqualTo(1000));
            }
            for (var i = 0; i < 1000; i++) Assert.That(table.ReleaseForScripts(i, i + 1), Is.True);
            Assert.That(table.Count, Is.EqualTo(0));
        }

        private static int Sent(LinkTable table, PagedArray<bool> known)
        {
            var request = new StepRequest(null, null);
            table.Flush(request, known);
            return request.Links.Count;
        }

        private static void Flush(LinkTable table, HashSet<(int, int)> engine, PagedArray<bool> known)
        {
            var request = new StepRequest(null, null);
            table.Flush(request, known);
            for (var i = 0; i < request.LinksRemoved.Count; i++)
            {
                var link = request.LinksRemoved.Items[i];
                Assert.That(engine.Remove((link.From, link.To)), Is.True, "only links that the engine has are removed");
            }
            for (var i = 0; i < request.Links.Count; i++)
            {
                var link = request.Links.Items[i];
                Assert.That(known[link.From] && known[link.To], Is.True, "links of unknown nodes wait");
                engine.Add((link.From, link.To));
            }
        }

        private static void Release(Dictionary<(int, int), int> model, (int, int) link)
        {
            if (!model.TryGetValue(link, out var count)) return;
            if (count == 1) model.Remove(link);
            else model[link] = count - 1;
        }

        private static void RemoveAll(Dictionary<(int, int), int> model, int node)
        {
            foreach (var link in new List<(int, int)>(model.Keys))
            {
                if (link.Item1 == node || link.Item2 == node) model.Remove(link);
            }
        }
    }
}
