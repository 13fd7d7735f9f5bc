using System.Runtime.InteropServices;

namespace Collektive.Unity
{
    /// <summary>A node that a search found near a point.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct NearNode
    {
        // The fields must have the layout of NearPoint.
        internal int Place;
        internal int IdOfNode;
        internal float Metres;

        /// <summary>The node's id.</summary>
        public int Id => IdOfNode;

        /// <summary>Distance from the point in metres, at the beginning of this tick.</summary>
        public float Distance => Metres;
    }
}
