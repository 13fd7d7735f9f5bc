using System;
using System.Collections.Generic;

namespace Collektive.Unity
{
    /// <summary>A value of each node by which a replay can colour nodes.</summary>
    public sealed class NodeColouring
    {
        /// <summary>Creates a colouring by numbers, or by categories if <see cref="IsCategory"/> is set.</summary>
        /// <param name="name">Shown in the legend; different for each colouring of a scene.</param>
        /// <param name="read">Returns the node's value, or NaN without one. Called between ticks, on the main thread, for each recorded frame.</param>
        public NodeColouring(string name, Func<Node, double> read)
        {
            Name = name ?? throw new ArgumentNullException(nameof(name));
            Read = read ?? throw new ArgumentNullException(nameof(read));
        }

        /// <summary>Shown in the legend.</summary>
        public string Name { get; }

        /// <summary>Returns the node's value, or NaN without one.</summary>
        public Func<Node, double> Read { get; }

        /// <summary>Unit of the numbers, for example <c>m</c>, or null (default).</summary>
        public string Unit { get; set; }

        /// <summary>
        /// Whether the values are whole numbers between -2^30 and 2^30 that name something, such as ids of leaders: each gets its own colour
        /// instead of a place on a scale. Default: false.
        /// </summary>
        public bool IsCategory { get; set; }

        /// <summary>Names of the categories 0, 1, ...; empty (default) to show numbers.</summary>
        public IReadOnlyList<string> Categories { get; set; } = Array.Empty<string>();
    }
}
