using System;
using System.IO;
using Collektive.Bridge;

namespace Collektive.Headless.Bench
{
    /// <summary>Measures a tick against its peers, without Unity: see <c>./collektive bench tick --help</c>.</summary>
    internal static class Program
    {
        private const int JvmStopLimitMs = 5000;

        private static int Main(string[] arguments)
        {
            try
            {
                new Benchmark(BenchSettings.Parse(arguments)).Run();
                // The JVM stops before the managed runtime, because its threads and signal handlers must not outlive Mono's.
                Jvm.Stop(JvmStopLimitMs);
                return 0;
            }
            catch (BenchException error)
            {
                Console.Error.WriteLine("collektive: bench: " + error.Message);
            }
            catch (BridgeException error)
            {
                Console.Error.WriteLine("collektive: bench: " + error.Message);
            }
            catch (IOException error)
            {
                Console.Error.WriteLine("collektive: bench: cannot write the results: " + error.Message);
            }
            return 1;
        }
    }
}
