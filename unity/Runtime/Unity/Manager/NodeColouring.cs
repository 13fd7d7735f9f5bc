using System;
using System.Collections.Generic;

namespace Collektive.Unity
{
    /// <summary>A value of each node by which a replay can colour nodes.</summary>
    public sealed class NodeColouring
    {
        /// <summary>Creates a colouring by numbers, or by categories if <see cref="IsCategory"/> is set.</summary>
        /// <param name="name">The name in the legend, unique among the colourings of a scene.</param>
        /// <param name="read">
        /// Returns the node's value, or NaN if it has none. Called between ticks on the main thread, once per node and recorded frame.
        /// </param>
        public NodeColouring(string name, Func<Node, double> read)
        {
            Name = name ?? throw new ArgumentNullException(nameof(name));
            Read = read ?? throw new ArgumentNullException(nameof(read));
        }

        /// <summary>The name in the legend.</summary>
        public string Name { get; }

        /// <summary>Returns the node's value, or NaN without one.</summary>
        public Func<Node, double> Read { get; }

        /// <summary>Unit of the numbers, for example <c>m</c>, or null (default).</summary>
        public string Unit { get; set; }

        /// <summary>
        /// Whether the values are identifiers, such as ids of leaders, rather than quantities. They must be whole numbers between -2^30 and 2^30, and each
        /// gets its own colour instead of a colour on a scale. Default: false.
        /// </summary>
        public bool IsCategory { get; set; }

        /// <summary>Names of the categories 0, 1, ...; empty (default) to show numbers.</summary>
        public IReadOnlyList<string> Categories { get; set; } = Array.Empty<string>();
    }
}
