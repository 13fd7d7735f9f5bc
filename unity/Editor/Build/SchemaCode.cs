using System.IO;

namespace Collektive.Unity.Editor
{
    /// <summary>Generates the code of schemas with the package's generator.</summary>
    internal static class SchemaCode
    {
        /// <summary>Generates the C# code that sensors and actuators use.</summary>
        /// <returns>Whether the code was generated. If not, the errors are logged.</returns>
        internal static bool MakeCSharp(SchemaProject project)
        {
            var java = Toolchain.FindJava();
            var (code, output) = ToolRun.Try(
                ".", java, "-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1", "-jar", Toolchain.Generator, "--flatc", Toolchain.Flatc(),
                "--include", Toolchain.SchemaFolder, "--schema", Path.GetFullPath(project.Schema), "--csharp", Path.GetFullPath(project.Generated));
            ToolConsole.Show("the generator of " + project.Schema, code, output);
            return code == 0;
        }
    }
}
