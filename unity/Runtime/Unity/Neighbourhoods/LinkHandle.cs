namespace Collektive.Unity
{
    /// <summary>A hold on the links of a pair of nodes, one way or both; stale once they are gone.</summary>
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
