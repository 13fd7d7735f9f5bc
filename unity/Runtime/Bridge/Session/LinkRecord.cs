using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>A directed link, on which <see cref="To"/> receives messages from <see cref="From"/>.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct LinkRecord
    {
        /// <summary>Id of the sender.</summary>
        public int From;

        /// <summary>Id of the receiver.</summary>
        public int To;

        /// <summary>Metres, 0 or greater.</summary>
        public float Length;

        /// <summary>Attenuation, 0 (none) or greater.</summary>
        public float Attenuation;
    }

    /// <summary>The ends of a directed link.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct LinkEnds
    {
        /// <summary>Id of the sender.</summary>
        public int From;

        /// <summary>Id of the receiver.</summary>
        public int To;
    }
}
