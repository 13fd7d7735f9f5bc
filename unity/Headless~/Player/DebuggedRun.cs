using System;
using System.Globalization;
using System.IO;
using System.Threading;
using Collektive.Bridge;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>Prepares a run for a debugger. The run begins when a debugger has attached to the JVM, and can stop at breakpoints for any time.</summary>
    internal static class DebuggedRun
    {
        private const int PollMs = 100;

        /// <summary>Starts the JVM with a debug port, and waits until a debugger has attached or the run is interrupted.</summary>
        internal static void AwaitDebugger(JvmSettings jvm, SimulationSettings settings, int port, Interrupt interrupt)
        {
            jvm.debugPort = port;
            settings.stepLimitMs = int.MaxValue;
            Jvm.Start(Installation.ToLaunch(jvm));
            Console.Error.WriteLine("collektive: waiting for a debugger on 127.0.0.1:" + port);
            while (!HasConnection(port) && !interrupt.Requested) Thread.Sleep(PollMs);
        }

        /// <summary>Returns whether /proc/net/tcp lists an established connection to a port of the loopback interface.</summary>
        private static bool HasConnection(int port)
        {
            const string established = "01";
            var local = "0100007F:" + port.ToString("X4", CultureInfo.InvariantCulture);
            foreach (var line in File.ReadAllLines("/proc/net/tcp"))
            {
                var words = line.Split(new[] { ' ' }, StringSplitOptions.RemoveEmptyEntries);
                if (words.Length > 3 && words[1] == local && words[3] == established) return true;
            }
            return false;
        }
    }
}
