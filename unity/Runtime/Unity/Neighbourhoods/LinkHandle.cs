namespace Collektive.Unity
{
    /// <summary>A reference to the links of a pair of nodes in one or both directions; stale once they are removed.</summary>
    internal readonly struct LinkHandle
    {
        internal readonly int Pair;
        internal readonly int Generation;
        internal readonly bool Up;
        internal readonly bool Down;

        internal LinkHandle(int pair, int generation, bool up, bool down)
        {
            Pair = pair;
            Generation = generation;
            Up = up;
            Down = down;
        }
    }
}
