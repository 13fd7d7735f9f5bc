namespace Collektive.Unity.Editor
{
    /// <summary>Whether Play starts with the previous programs after a failed build.</summary>
    internal enum WhenProgramsFail
    {
        Ask,
        Always,
        Never,
    }
}
