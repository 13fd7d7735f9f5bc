using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>A directed link as the frame holds it: <see cref="To"/> receives what <see cref="From"/> sends.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct LinkRecord
    {
        /// <summary>Id of the sender.</summary>
        public int From;

        /// <summary>Id of the receiver.</summary>
        public int To;

        /// <summary>Metres, 0 or greater.</summary>
        public float Length;

        /// <summary>0 (clear) or greater.</summary>
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
