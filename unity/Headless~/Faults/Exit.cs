using System;
using System.Threading;
using Collektive.Bridge;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Faults
{
    /// <summary>Plays the scene <see cref="Ending"/> on a runtime that the headless player does not support.</summary>
    internal static class Exit
    {
        private const int Ticks = 40;
        private const int LimitMs = 10000;
        private const int SigInt = 2;
        private const int SigTerm = 15;

        private static readonly ManualResetEventSlim Ended = new ManualResetEventSlim();
        private static volatile int signal;

        /// <returns>The exit code.</returns>
        internal static int Play(Setting setting, string how)
        {
            Console.CancelKeyPress += (sender, key) =>
            {
                key.Cancel = true;
                signal = SigInt;
            };
            // Also raised by SIGTERM. The process ends when the handlers have returned.
            AppDomain.CurrentDomain.ProcessExit += (sender, arguments) =>
            {
                signal = SigTerm;
                Ended.Wait(LimitMs);
            };
            AppDomain.CurrentDomain.UnhandledException += (sender, unhandled) => Jvm.Stop(LimitMs);
            try
            {
                return Play(setting, how, how == "ctrl-c" || how == "termination" ? int.MaxValue : Ticks);
            }
            finally
            {
                // Stops the JVM.
                Loop.Quit();
                Ended.Set();
            }
        }

        private static int Play(Setting setting, string how, int frames)
        {
            Loop.Start(1);
            var manager = Scene.MakeManager(setting);
            var holder = new GameObject("Scene");
            holder.SetActive(false);
            var ending = holder.AddComponent<Ending>();
            ending.how = how;
            holder.SetActive(true);
            var metrics = new double[1];
            for (var frame = 0; frame < frames && signal == 0 && !Loop.QuitRequested; frame++)
            {
                Loop.Frame(manager.Settings.deltaTime);
                try
                {
                    ending.Measure(metrics);
                }
                catch (InvalidOperationException error)
                {
                    Console.WriteLine(error);
                    return 1;
                }
            }
            return signal != 0 ? 128 + signal : Loop.ExitCode;
        }
    }
}
