namespace Collektive.Unity
{
    /// <summary>What a <see cref="LinkView"/> colours links by.</summary>
    public enum LinkColoring
    {
        /// <summary>Whether the two nodes hear each other, or only one the other.</summary>
        Direction,

        /// <summary>The length in metres.</summary>
        Length,

        /// <summary>The attenuation.</summary>
        Attenuation,

        /// <summary>The number that <see cref="LinkView.Value"/> gives.</summary>
        Value,
    }
}
