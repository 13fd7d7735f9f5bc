using System;
using System.Runtime.InteropServices;
using Collektive.Bridge;
using NUnit.Framework;

namespace Collektive.Headless.Tests
{
    /// <summary>Tests the C# side of the neighbour search. The C tests compare searches and links with models.</summary>
    [TestFixture]
    public sealed class NeighbourSearchTests
    {
        private NeighbourSearch search;
        private StepRequest request;

        [SetUp]
        public void Create()
        {
            search = new NeighbourSearch();
            request = new StepRequest(null, null);
        }

        [TearDown]
        public void Dispose() => search.Dispose();

        [Test]
        public void Records_have_the_sizes_of_their_C_structs()
        {
            var sizes = new[]
            {
                Marshal.SizeOf<NodePoint>(), Marshal.SizeOf<NearPoint>(), Marshal.SizeOf<RuleSearch>(), Marshal.SizeOf<RuleNeighbour>(),
                Marshal.SizeOf<LinkRecord>(), Marshal.SizeOf<LinkEnds>(), Marshal.SizeOf<LinkDirection>(), Marshal.SizeOf<LinkPair>(),
                Marshal.SizeOf<Shim.LinkChanges>(), Marshal.SizeOf<Shim.LinkPairs>(),
            };
            Assert.That(sizes, Is.EqualTo(new[] { 16, 12, 28, 12, 16, 8, 16, 44, 24, 24 }));
        }

        [Test]
        public void Changes_of_links_are_appended_to_the_request_once()
        {
            var rule = search.AddRule();
            for (var id = 3; id < 7; id++) search.Know(id, true);
            search.Take(rule, 3, new[] { Neighbour(5, 2), Neighbour(4, 1) }, 0, true);
            request.SetLink(new LinkRecord { From = 8, To = 9 });
            search.Flush(request);
            search.Flush(request);
            Assert.That(Links(), Is.EqualTo("8>9:0 3>4:1 4>3:1 3>5:2 5>3:2 removed"));
            Assert.That(search.Count, Is.EqualTo(4));
            request.Clear();
            search.Take(rule, 3, new[] { Neighbour(4, 7) }, 0, true);
            search.Flush(request);
            Assert.That(Links(), Is.EqualTo("3>4:7 4>3:7 removed 3>5 5>3"));
        }

        [Test]
        public void A_large_block_of_changes_is_appended_whole()
        {
            const int count = 1000;
            var rule = search.AddRule();
            var list = new RuleNeighbour[count];
            for (var i = 0; i <= count; i++) search.Know(i, true);
            for (var i = 0; i < count; i++) list[i] = Neighbour(i + 1, i);
            search.Take(rule, 0, list, 0, false);
            search.Flush(request);
            Assert.That(request.Links.Count, Is.EqualTo(count));
            for (var i = 0; i < count; i++) Assert.That((request.Links.Items[i].To, request.Links.Items[i].Length), Is.EqualTo((i + 1, (float)i)));
        }

        [Test]
        public void Links_of_unknown_and_dropped_nodes_are_not_sent()
        {
            var rule = search.AddRule();
            search.Know(0, true);
            search.Take(rule, 0, new[] { Neighbour(1, 1), Neighbour(2, 1) }, 0, false);
            search.Flush(request);
            Assert.That(Links(), Is.EqualTo("removed"));
            search.Know(1, true);
            search.Drop(new[] { 2 });
            search.Flush(request);
            Assert.That(Links(), Is.EqualTo("0>1:1 removed"));
            Assert.That((search.Has(0, 1), search.Has(0, 2)), Is.EqualTo((true, false)));
        }

        [Test]
        public void Scripts_reference_a_link_once()
        {
            search.Hold(new LinkRecord { From = 1, To = 2, Length = 3 });
            search.Hold(new LinkRecord { From = 1, To = 2, Length = 4 });
            Assert.That((search.Count, search.Pairs[0].Up.Length), Is.EqualTo((1, 4f)));
            Assert.That((search.Release(1, 2), search.Release(1, 2), search.Count), Is.EqualTo((true, false, 0)));
        }

        [Test]
        public void Wrong_arguments_are_errors()
        {
            Assert.That(() => search.Take(5, 0, new RuleNeighbour[1], 0, true), Throws.InstanceOf<BridgeException>());
            Assert.That(() => search.Update(new RuleSearch[1], 1, 10), Throws.InstanceOf<BridgeException>());
            Assert.That(search.TryPlace(new[] { new NodePoint { Y = float.NaN } }), Is.False);
        }

        private static RuleNeighbour Neighbour(int id, float length) => new RuleNeighbour { Id = id, Length = length };

        private string Links()
        {
            var text = "";
            for (var i = 0; i < request.Links.Count; i++)
            {
                var link = request.Links.Items[i];
                text += link.From + ">" + link.To + ":" + link.Length + " ";
            }
            text += "removed";
            for (var i = 0; i < request.LinksRemoved.Count; i++) text += " " + request.LinksRemoved.Items[i].From + ">" + request.LinksRemoved.Items[i].To;
            return text;
        }
    }
}
