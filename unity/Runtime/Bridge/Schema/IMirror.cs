using System.ComponentModel;

namespace Collektive.Bridge
{
    /// <summary>A C# struct, called a mirror, that has exactly the memory layout of a struct in the schema.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public interface IMirror
    {
        /// <summary>Returns the path of the first field that is NaN or infinite, or null.</summary>
        string FindNotFinite();
    }
}
