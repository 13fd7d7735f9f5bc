using System.Runtime.InteropServices;

namespace Collektive.Unity
{
    /// <summary>A node near a point at the beginning of this tick.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct NearNode
    {
        // Same layout as NearPoint.
        internal int Place;
        internal int IdOfNode;
        internal float Metres;

        /// <summary>Its id.</summary>
        public int Id => IdOfNode;

        /// <summary>Metres from the point.</summary>
        public float Distance => Metres;
    }
}
