using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Threading;
using Collektive.Bridge;
using UnityEngine.Headless;

namespace Collektive.Headless.Soak
{
    /// <summary>
    /// Plays a scene whose nodes join, fail and leave for a given time, and reports growing memory or resources.
    /// Arguments are key=value: home, host, jar, seconds and optionally results (a file for JUnit XML). Exit code 1 when something grew.
    /// </summary>
    internal static class Program
    {
        private const int JvmStopLimitMs = 5000;
        private const int TicksPerSecond = 200;
        private const int Samples = 120;

        private static int Main(string[] arguments)
        {
            var values = new Dictionary<string, string>();
            foreach (var argument in arguments)
            {
                var parts = argument.Split(new[] { '=' }, 2);
                values[parts[0]] = parts[1];
            }
            var seconds = double.Parse(values["seconds"], CultureInfo.InvariantCulture);
            Loop.Start(1);
            var scene = new Churn(values["home"], values["host"], values["jar"]);
            var growth = new Growth();
            Play(scene, growth, seconds);
            var failed = scene.Failure.Length > 0;
            if (failed) Console.WriteLine("the simulation stopped: " + scene.Failure);
            Console.WriteLine(scene.Summary);
            failed |= !growth.Report(values.TryGetValue("results", out var file) ? file : null);
            Loop.Quit();
            Jvm.Stop(JvmStopLimitMs);
            return failed ? 1 : 0;
        }

        /// <summary>Measurements start with the second minute, or with the second third of a short run.</summary>
        private static void Play(Churn scene, Growth growth, double seconds)
        {
            var settled = Math.Min(60, seconds / 3);
            var clock = Stopwatch.StartNew();
            var nextSample = settled;
            var nextTick = 0.0;
            var nextSession = 1.0;
            for (double now = 0; now < seconds && scene.Failure.Length == 0; now = clock.Elapsed.TotalSeconds)
            {
                scene.Frame();
                if (now >= nextSession)
                {
                    nextSession = now + 1;
                    scene.PlaySession();
                }
                if (now >= nextSample)
                {
                    nextSample = now + (seconds - settled) / Samples;
                    growth.Add(Sample.Take());
                }
                // Late ticks are skipped, so that the load is equal on all machines that keep pace.
                nextTick = Math.Max(nextTick + 1.0 / TicksPerSecond, now);
                var wait = nextTick - clock.Elapsed.TotalSeconds;
                if (wait > 0) Thread.Sleep(TimeSpan.FromSeconds(wait));
            }
        }
    }
}
