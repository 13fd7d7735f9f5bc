using System.IO;

namespace Collektive.Unity.Editor
{
    /// <summary>Makes the package anew from a source checkout, for people who work on the package itself.</summary>
    internal static class BackendBuild
    {
        /// <returns>The path of the new tarball; null when it failed, and the console says why.</returns>
        /// <exception cref="ToolException">There is no source checkout.</exception>
        internal static string Make()
        {
            var checkout = ProjectSettings.instance.sourceCheckout;
            if (checkout.Length == 0)
                throw new ToolException("the backend is built from a source checkout of the package: name its folder in Project Settings > Collektive");
            var command = Path.Combine(checkout, "collektive");
            if (!File.Exists(command))
                throw new ToolException(checkout
                    + " is no source checkout of the package (it has no command collektive): correct it in Project Settings > Collektive");
            var (code, output) = ToolRun.Try(checkout, command, "package");
            ToolConsole.Show("collektive package", code, output);
            if (code != 0) return null;
            // The command's last line names the archive.
            var lines = output.TrimEnd().Split('\n');
            return lines[lines.Length - 1];
        }
    }
}
