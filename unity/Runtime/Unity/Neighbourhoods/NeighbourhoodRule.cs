using Collektive.Bridge;
using UnityEngine;

namespace Collektive.Unity
{
    /// <summary>
    /// Decides which nodes receive a node's messages. Before each tick <see cref="FindNeighbours"/> collects the neighbours; the rule adds
    /// and removes the links. A node may have several rules: a link exists while one of them, or a script, references it.
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

        // Where the rule has its links; null before its first tick.
        private NeighbourSearch links;
        private int number = NeighbourSearch.NoRule;
        // Users' code may do anything with physics.
        private bool isOwn;

        /// <summary>Whether neighbours receive messages from this node without sending to it. Takes effect for new links.</summary>
        public bool Directed
        {
            get => directed;
            set => directed = value;
        }

        /// <summary>
        /// Metres, 0 or greater. A link's length is sent to the JVM when the link is created, and again after it changed by more than this: in a
        /// swarm all lengths change a little in each tick, and sending them can cost as much as the rounds.
        /// </summary>
        public float LengthTolerance
        {
            get => lengthTolerance;
            set => lengthTolerance = value;
        }

        /// <summary>Whether <see cref="FindNeighbours"/> only requests a search, which runs together with those of all nodes.</summary>
        internal virtual bool IsSearch => false;

        internal sealed override ref PartList ListOf(Node node)
        {
            isOwn = GetType().Assembly == typeof(NeighbourhoodRule).Assembly;
            return ref node.Rules;
        }

        internal sealed override void Detached() => ReleaseAll();

        /// <summary>Updates the links of this rule, unless it <see cref="IsSearch"/>.</summary>
        internal sealed override void Run(TickContext tick, int index)
        {
            if (IsSearch) return;
            var neighbours = tick.Neighbours;
            if (!isOwn) tick.Queries.Finish();
            Prepare(tick);
            neighbours.Begin(Node);
            try
            {
                FindNeighbours(neighbours);
                // Skipped if the call removed the rule or its node, and with it the links.
                if (IsAttached && Node.Id >= 0) tick.Links.Take(NumberIn(tick.Links), Node.Id, neighbours.All, lengthTolerance, !directed);
            }
            finally
            {
                // After an exception the links stay as they were.
                neighbours.End();
            }
        }

        /// <summary>Adds the search of a rule that <see cref="IsSearch"/>. The node is at index <paramref name="nodeIndex"/> of the grid.</summary>
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
