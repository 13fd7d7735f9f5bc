namespace Collektive.Bridge
{
    /// <summary>A C# struct with exactly the memory layout of a struct of the schema.</summary>
    public interface IMirror
    {
        /// <summary>Path of the first field that is NaN or infinite, else null.</summary>
        string FindNotFinite();
    }
}
