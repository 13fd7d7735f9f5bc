using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>The position of a node.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct NodePoint
    {
        internal float X;
        internal float Y;
        internal float Z;
        internal int Id;
    }

    /// <summary>A point found by a search.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct NearPoint
    {
        internal int Index;
        internal int Id;
        internal float Distance;
    }

    /// <summary>A search that a neighbourhood rule requests.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct RuleSearch
    {
        /// <summary>Value of <see cref="Nearest"/> that requests all points within the distance.</summary>
        internal const int All = -1;

        internal int Rule;
        internal int Centre;
        internal int Nearest;
        internal float Inner;
        internal float Outer;
        internal float Tolerance;
        internal int BothWays;
    }

    /// <summary>A neighbour found by a rule.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct RuleNeighbour
    {
        internal int Id;
        internal float Length;
        internal float Attenuation;
    }

    /// <summary>Two nodes and the links between them. A link exists while its reference count is positive.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct LinkPair
    {
        internal int Low;
        internal int High;
        // Used by the native code only.
        internal int Next;
        // Up is the link from the lower id to the higher; Down is the opposite link.
        internal LinkDirection Up;
        internal LinkDirection Down;

        internal bool IsReferenced => Up.References > 0 || Down.References > 0;
    }

    /// <summary>The link of a pair in one direction.</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct LinkDirection
    {
        internal float Length;
        internal float Attenuation;
        internal int References;
        // Used by the native code only.
        internal int State;

        internal LinkRecord Record(int from, int to) => new LinkRecord { From = from, To = to, Length = Length, Attenuation = Attenuation };
    }
}
