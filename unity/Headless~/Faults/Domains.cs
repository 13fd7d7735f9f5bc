using System;
using System.Threading;
using Collektive.Headless.Tests;

namespace Collektive.Headless.Faults
{
    /// <summary>Plays in C# domains that are unloaded afterwards, as the editor does after each change of a script.</summary>
    internal static class Domains
    {
        private const int Times = 50;

        /// <summary>Whether all plays went well and left no session, slot or thread behind.</summary>
        internal static bool Play()
        {
            var arguments = Array.FindAll(Environment.GetCommandLineArgs(),
                argument => argument.Contains("=") && !argument.StartsWith("act=", StringComparison.Ordinal));
            Array.Resize(ref arguments, arguments.Length + 1);
            var threads = 0;
            for (var i = 0; i < Times; i++)
            {
                // Every third one is unloaded in the middle of its play.
                arguments[arguments.Length - 1] = i % 3 == 2 ? "act=play-on" : "act=play";
                var domain = AppDomain.CreateDomain("play " + i);
                var code = domain.ExecuteAssembly(typeof(Domains).Assembly.Location, arguments);
                AppDomain.Unload(domain);
                if (code != 0 || ShimCounts.Sessions != 0 || ShimCounts.Slots != 0)
                {
                    Console.WriteLine("play " + i + ": code " + code + ", " + ShimCounts.Sessions + " sessions, " + ShimCounts.Slots + " slots");
                    return false;
                }
                if (i == 10) threads = Settled();
            }
            var left = Settled() - threads;
            Console.WriteLine(left + " threads more after " + Times + " domains");
            return left <= 2;
        }

        private static int Settled()
        {
            Thread.Sleep(300);
            return ShimCounts.Threads;
        }
    }
}
