using System;
using System.IO;
using System.Text.RegularExpressions;
using Collektive.Bridge;
using Mono.Unix.Native;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>Runs scenario files without Unity. The package's sources are compiled against a stand-in for Unity's API.</summary>
    internal static class Program
    {
        private const int JvmStopLimitMs = 5000;

        /// <summary>The exit code after a file error. The manifest may not contain the error, for example because the disk is full.</summary>
        private const int FileError = 74;

        private static int Main(string[] arguments)
        {
            // If a thread that a script started throws an exception, the runtime prints it and ends the process. The JVM must be stopped before that.
            AppDomain.CurrentDomain.UnhandledException += (sender, unhandled) => StopJvm(1);
            var code = StopJvm(Run(arguments));
            Console.Out.Flush();
            // A return from Main would wait for the foreground threads that scripts have started.
            Exit(code);
            return code;
        }

        /// <summary>Ends the process immediately, even if scripts have started threads.</summary>
        internal static void Exit(int code)
        {
            // The JVM would remove this socket in an exit handler, which does not run here.
            Syscall.unlink("/tmp/.java_pid" + Syscall.getpid());
            Syscall._exit(code);
        }

        /// <summary>Stops the JVM. This must happen before Mono ends, because the JVM's threads and signal handlers must not outlive it.</summary>
        /// <returns>The exit code: <paramref name="code"/>, or at least 1 if the JVM did not stop.</returns>
        private static int StopJvm(int code)
        {
            try
            {
                Jvm.Stop(JvmStopLimitMs);
            }
            catch (BridgeException error)
            {
                Console.Error.WriteLine("collektive: the JVM did not shut down: " + error.Message);
                return Math.Max(code, 1);
            }
            return code;
        }

        private static int Run(string[] arguments)
        {
            try
            {
                var options = Options.Parse(arguments);
                if (options.Command == "serve")
                {
                    new Server(options).Serve();
                    return 0;
                }
                var scenario = Scenario.Read(options.Scenario, options.Folder, options.TrustJvm, options.Assignments.ToArray());
                if (options.Command == "plan")
                {
                    scenario.Override(options.Seed, options.Seconds);
                    foreach (var field in options.FieldAssignments) Assignment.OfField(field).Apply(scenario.File.Root);
                    Plan(scenario);
                    return 0;
                }
                return new ScenarioRun(scenario, options, new Interrupt()).Run();
            }
            catch (Exception error)
            {
                return Report(error);
            }
        }

        /// <summary>Prints the reason why a run ended.</summary>
        /// <returns>The exit code.</returns>
        internal static int Report(Exception error)
        {
            // A terminal would execute control characters.
            Console.Error.WriteLine("collektive: " + Regex.Replace(Describe(error), @"[\p{Cc}-[\n\t]]", found => "\\x" + ((int)found.Value[0]).ToString("x2")));
            return error is IOException || error is UnauthorizedAccessException ? FileError : 1;
        }

        /// <summary>Returns a message for users. For an unexpected exception, it contains the stack trace.</summary>
        internal static string Describe(Exception error) => error is ScenarioException || error is BridgeException ? error.Message
            : error is IOException || error is UnauthorizedAccessException ? "a file could not be read or written: " + error.Message
            : "the run ended with an unhandled exception: " + error;

        /// <summary>Prints the inputs of the scenario, and the content of its file with the assigned values, as JSON.</summary>
        private static void Plan(Scenario scenario) => Console.WriteLine(JsonFile.Text(new JObject(
            new JProperty("file", scenario.File.Root),
            new JProperty("scripts", scenario.Scripts),
            new JProperty("schema", scenario.Schema),
            new JProperty("programs", scenario.Programs),
            new JProperty("data", scenario.Data),
            new JProperty("program", scenario.Settings.program),
            new JProperty("runtimeJars", scenario.RuntimeJars),
            new JProperty("runtimePlugin", scenario.RuntimePlugin),
            new JProperty("seed", scenario.Settings.seed.ToString()),
            new JProperty("replay", scenario.Replay),
            new JProperty("pictures", scenario.Pictures))));
    }
}
