using System.IO;

namespace Collektive.Unity.Editor
{
    /// <summary>Builds the package from a source checkout, for developers of the package.</summary>
    internal static class BackendBuild
    {
        /// <returns>The path of the new tarball, or null if the build failed. The failure is logged.</returns>
        /// <exception cref="ToolException">The preferences do not name a source checkout.</exception>
        internal static string Make()
        {
            var checkout = PersonalSettings.instance.sourceCheckout;
            if (checkout.Length == 0)
                throw new ToolException("Rebuild Backend needs a source checkout of the package: set its folder in Preferences > Collektive");
            var command = Path.Combine(checkout, "collektive");
            if (!File.Exists(command))
                throw new ToolException(checkout
                    + " is not a source checkout of the package (the command collektive is missing): correct the folder in Preferences > Collektive");
            var (code, output) = ToolRun.Try(checkout, command, "package");
            ToolConsole.Show("collektive package", code, output);
            if (code != 0) return null;
            // The last line of the command's output is the path of the archive.
            var lines = output.TrimEnd().Split('\n');
            return lines[lines.Length - 1];
        }
    }
}
