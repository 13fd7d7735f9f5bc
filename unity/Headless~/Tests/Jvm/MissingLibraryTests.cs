using System;
using System.Diagnostics;
using System.IO;
using NUnit.Framework;

namespace Collektive.Headless.Tests
{
    /// <summary>
    /// Tests a process without a usable native library that plays 50 frames. It must report a single error, which names the platform and the solution, and
    /// throw no exception. The tests start separate processes, because this process has loaded the library.
    /// </summary>
    [TestFixture, Category("AnyPlacement")]
    public sealed class MissingLibraryTests
    {
        private const string Library = "libcollektive_shim.so";
        private const string Program = "Collektive.WithoutLibrary.exe";
        private const int LimitMs = 60000;

        private string folder;

        private static string Assemblies => AppDomain.CurrentDomain.BaseDirectory;

        [SetUp]
        public void MakeFolder()
        {
            folder = Path.Combine(Path.GetTempPath(), "collektive-library-" + Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(folder);
        }

        [TearDown]
        public void RemoveFolder() => Directory.Delete(folder, true);

        [TestCase("editor", Category = "Repeats")]
        [TestCase("player")]
        public void A_missing_library_logs_one_error(string where) => CheckOneError(Play(where), "Linux", "X64");

        [TestCase("editor", Category = "Repeats")]
        [TestCase("player")]
        public void A_library_of_another_platform_logs_one_error(string where)
        {
            File.WriteAllText(Path.Combine(folder, Library), "MZ: not for this platform");
            CheckOneError(Play(where), "Linux", "X64");
        }

        [Test, Category("Repeats")]
        public void An_unrelated_library_of_that_name_logs_one_error()
        {
            File.Copy(Path.Combine(TestJvm.Home, "lib/libjli.so"), Path.Combine(folder, Library));
            CheckOneError(Play("editor"), "clk_version");
        }

        [TestCase("editor")]
        [TestCase("player")]
        public void An_unsupported_platform_logs_one_error(string where)
        {
            foreach (var assembly in Directory.GetFiles(Assemblies, "*.dll")) File.Copy(assembly, Path.Combine(folder, Path.GetFileName(assembly)));
            File.Copy(Path.Combine(Assemblies, Program), Path.Combine(folder, Program));
            File.Copy(Path.Combine(Assemblies, "libcollektive_physics.so"), Path.Combine(folder, "libcollektive_physics.so"));
            File.Copy(Path.Combine(Assemblies, "stubs/Collektive.Bridge.dll"), Path.Combine(folder, "Collektive.Bridge.dll"), true);
            CheckOneError(Play(where, folder), "this platform does not support a JVM inside the process");
        }

        private static void CheckOneError(string output, params string[] parts)
        {
            Assert.That(output, Is.StringStarting("exceptions 0, errors 1, manager off\n"));
            foreach (var part in parts) Assert.That(output, Is.StringContaining(part));
            Assert.That(output, Is.StringContaining("see Limits in the documentation"));
        }

        private string Play(string where) => Play(where, Assemblies);

        /// <summary>Runs the process with the assemblies in a folder, and returns its summary of errors.</summary>
        private string Play(string where, string assemblies)
        {
            var arguments = "--debug \"" + Path.Combine(assemblies, Program) + "\" " + where;
            var start = new ProcessStartInfo(TestJvm.Variable("COLLEKTIVE_RUNTIME"), arguments)
            {
                UseShellExecute = false,
                RedirectStandardOutput = true,
                RedirectStandardError = true,
            };
            start.EnvironmentVariables["LD_LIBRARY_PATH"] = folder;
            using (var process = Process.Start(start))
            {
                var output = process.StandardOutput.ReadToEndAsync();
                var errors = process.StandardError.ReadToEndAsync();
                if (!process.WaitForExit(LimitMs))
                {
                    process.Kill();
                    Assert.Fail("the process did not end: " + output.Result + errors.Result);
                }
                var result = output.Result.IndexOf("exceptions ", StringComparison.Ordinal);
                Assert.That(result, Is.GreaterThanOrEqualTo(0), output.Result + errors.Result);
                return output.Result.Substring(result);
            }
        }
    }
}
