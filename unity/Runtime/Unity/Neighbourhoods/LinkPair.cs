namespace Collektive.Unity
{
    /// <summary>Two nodes and their links. A link exists while its reference count is positive.</summary>
    internal struct LinkPair
    {
        internal int Low;
        internal int High;
        internal int Generation;
        internal int NextInBucket;
        // From the lower id to the higher, and back.
        internal LinkDirection Up;
        internal LinkDirection Down;

        internal bool IsReferenced => Up.References > 0 || Down.References > 0;

        internal bool IsDirty => Up.Dirty || Down.Dirty;
    }

    /// <summary>One direction of a pair.</summary>
    internal struct LinkDirection
    {
        internal float Length;
        internal float Attenuation;
        internal int References;
        internal bool Sent;
        internal bool Dirty;
        internal bool ByScript;
    }
}
