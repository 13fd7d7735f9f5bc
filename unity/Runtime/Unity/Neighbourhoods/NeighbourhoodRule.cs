using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Decides which nodes receive a node's messages. Before each tick, <see cref="FindNeighbours"/> collects the neighbours, and the links of the rule are
    /// updated accordingly. A node may have several rules. A link exists while at least one rule or script references it.
    /// </summary>
    [HelpPage("neighbourhoods.md")]
    public abstract class NeighbourhoodRule : NodePart
    {
        [SerializeField]
        [Tooltip("On: neighbours only receive messages from this node. Off: this node also receives messages from them.")]
        private bool directed;

        [SerializeField]
        [Min(0)]
        [Tooltip("Metres. A link's length is sent to the JVM again after it changed by more than this.")]
        private float lengthTolerance = 0.25f;

        // Stores the rule's links; null before the rule's first tick.
        private NeighbourSearch links;
        private int number = NeighbourSearch.NoRule;
        // Whether the rule is part of this package. Other rules may change physics, so running queries must finish before they are called.
        private bool isOwn;

        /// <summary>Whether neighbours only receive messages from this node, and do not send to it. A change affects new links only.</summary>
        public bool Directed
        {
            get => directed;
            set => directed = value;
        }

        /// <summary>
        /// Change in metres, 0 or greater, above which a link's length is sent to the JVM again. In a swarm, all lengths change slightly in each tick, and
        /// sending all of them can cost as much time as the rounds.
        /// </summary>
        public float LengthTolerance
        {
            get => lengthTolerance;
            set => lengthTolerance = value;
        }

        /// <summary>
        /// Whether <see cref="FindNeighbours"/> only requests a search. The searches of all nodes then run together. A rule with an invalid setting is called
        /// instead, and throws an exception.
        /// </summary>
        internal bool MustSearch => lengthTolerance >= 0 && IsSearch;

        /// <summary>Whether <see cref="FindNeighbours"/> only requests a search with valid settings.</summary>
        internal virtual bool IsSearch => false;

        internal sealed override ref PartList ListOf(Node node)
        {
            isOwn = GetType().Assembly == typeof(NeighbourhoodRule).Assembly;
            return ref node.Rules;
        }

        internal sealed override void Detached() => ReleaseAll();

        /// <summary>Updates the links of this rule. Does nothing if <see cref="MustSearch"/> is true.</summary>
        internal sealed override void Run(TickContext tick, int index)
        {
            if (MustSearch) return;
            CheckNotNegative("length tolerance", lengthTolerance);
            var neighbours = tick.Neighbours;
            var centre = Node;
            if (!isOwn) tick.Queries.Finish();
            Prepare(tick);
            neighbours.Begin(Node);
            try
            {
                FindNeighbours(neighbours);
                // The call may have removed the rule or its node, together with the links, or moved the rule to another node.
                if (IsAttached && ReferenceEquals(Node, centre) && Node.Id >= 0)
                    tick.Links.Take(NumberIn(tick.Links), Node.Id, neighbours.All, lengthTolerance, !directed);
            }
            finally
            {
                // After an exception, the previous links are kept.
                neighbours.End();
            }
        }

        /// <summary>
        /// Adds this rule's search to the searches of the tick, if <see cref="MustSearch"/> is true. <paramref name="nodeIndex"/> is the node's index in the
        /// grid.
        /// </summary>
        internal void AddSearch(TickContext tick, int nodeIndex)
        {
            ref var search = ref tick.Neighbours.Searches.Add();
            search = default;
            search.Rule = NumberIn(tick.Links);
            search.Centre = nodeIndex;
            search.Tolerance = lengthTolerance;
            search.BothWays = directed ? 0 : 1;
            FindNeighbours(tick.Neighbours);
        }

        /// <summary>Removes the rule's links.</summary>
        internal void ReleaseAll()
        {
            links?.RemoveRule(number);
            links = null;
            number = NeighbourSearch.NoRule;
        }

        /// <summary>Adds this node's current neighbours to <paramref name="neighbours"/>. Called once before each tick; must not allocate.</summary>
        protected abstract void FindNeighbours(NeighbourCollector neighbours);

        private int NumberIn(NeighbourSearch search)
        {
            if (number != NeighbourSearch.NoRule) return number;
            links = search;
            return number = search.AddRule();
        }
    }
}
