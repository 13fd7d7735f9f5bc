namespace Collektive.Unity
{
    /// <summary>The value by which a <see cref="LinkView"/> colours links.</summary>
    public enum LinkColouring
    {
        /// <summary>Whether the link exists in both directions or in one.</summary>
        Direction,

        /// <summary>The length in metres.</summary>
        Length,

        /// <summary>The attenuation.</summary>
        Attenuation,

        /// <summary>The number that <see cref="LinkView.Value"/> returns.</summary>
        Value,
    }
}
