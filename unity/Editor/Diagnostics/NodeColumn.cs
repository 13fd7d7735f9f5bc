using System;

namespace Collektive.Unity.Editor
{
    /// <summary>A column of the table of nodes.</summary>
    internal sealed class NodeColumn
    {
        internal NodeColumn(string name, float width, Func<NodeRow, string> text, Comparison<NodeRow> compare)
        {
            Name = name;
            Width = width;
            Text = text;
            Compare = compare;
        }

        internal string Name { get; }

        /// <summary>Width in pixels.</summary>
        internal float Width { get; }

        internal Func<NodeRow, string> Text { get; }

        internal Comparison<NodeRow> Compare { get; }
    }
}
