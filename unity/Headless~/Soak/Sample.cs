using System;
using System.Globalization;
using System.IO;
using System.Text.RegularExpressions;
using Collektive.Bridge;

namespace Collektive.Headless.Soak
{
    /// <summary>The resources of the process at one moment, in the order of <see cref="Growth.Measures"/>; memory in kilobytes, after collections.</summary>
    internal static class Sample
    {
        private const double Kibi = 1024;

        internal static double[] Take()
        {
            var jvm = Jvm.GetStatus(collect: true);
            return new[]
            {
                GC.GetTotalMemory(true) / Kibi, ResidentKb(), jvm.HeapUsed / Kibi, jvm.MetaspaceUsed / Kibi, jvm.Classes,
                Directory.GetDirectories("/proc/self/task").Length, Directory.GetFileSystemEntries("/proc/self/fd").Length,
            };
        }

        private static double ResidentKb() =>
            double.Parse(Regex.Match(File.ReadAllText("/proc/self/status"), "VmRSS:\\s*(\\d+)").Groups[1].Value, CultureInfo.InvariantCulture);
    }
}
