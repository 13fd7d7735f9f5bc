using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>State of the process's JVM.</summary>
    public enum JvmState
    {
        /// <summary>Never started in this process.</summary>
        None = 0,
        /// <summary>Running.</summary>
        Running = 1,
        /// <summary>Exited, aborted or silent; only a new process gets another.</summary>
        Lost = 2,
        /// <summary>Destroyed in order.</summary>
        Stopped = 3,
    }

    /// <summary>
    /// The JVM of this process. It is started once and outlives sessions, play modes and C# domains; a fresh domain finds it
    /// running. All members may be called from any thread.
    /// </summary>
    public static unsafe class Jvm
    {
        /// <summary>The state now. Never waits.</summary>
        public static JvmState State => (JvmState)Shim.clk_jvm_state();

        /// <summary>Home, version and options of the JVM, one a line; empty when none was started.</summary>
        public static string Description =>
            Utf8.Copied((buffer, capacity) => Shim.clk_jvm_description((byte*)buffer, capacity));

        /// <summary>Steps that reached the JVM since the process began, over all sessions.</summary>
        public static ulong StepCalls
        {
            get
            {
                var stats = new Shim.Stats { Size = (uint)sizeof(Shim.Stats) };
                Shim.Check(Shim.clk_get_stats(&stats));
                return stats.Steps;
            }
        }

        /// <summary>Starts the JVM, or does nothing when it runs with the same settings.</summary>
        /// <exception cref="BridgeException">The JVM, its options or the host's jar are not usable.</exception>
        public static void Start(JvmSettings settings)
        {
            var major = Shim.clk_version() >> 16;
            if (major != Shim.Major)
            {
                throw new BridgeException(
                    BridgeError.Host,
                    "the native library collektive_shim is of version " + major + ", this package needs " + Shim.Major +
                    ": reinstall the package and restart the editor");
            }
            var strings = new List<IntPtr>();
            var options = settings.Options;
            var pointers = stackalloc byte*[options.Count + 1];
            try
            {
                for (var i = 0; i < options.Count; i++) pointers[i] = Text(strings, options[i]);
                var config = new Shim.JvmConfig
                {
                    Size = (uint)sizeof(Shim.JvmConfig),
                    OptionCount = options.Count,
                    Home = Text(strings, settings.Home),
                    ClassPath = Text(strings, settings.ClassPath),
                    Options = pointers,
                    StartLimitMs = settings.StartLimitMs,
                    CheckOptions = 1,
                };
                Shim.Check(Shim.clk_jvm_start(&config));
            }
            finally
            {
                foreach (var memory in strings) Marshal.FreeHGlobal(memory);
            }
        }

        /// <summary>Destroys the JVM; for the end of the process only, since none can follow it.</summary>
        /// <exception cref="BridgeException">It did not end within <paramref name="limitMs"/> milliseconds.</exception>
        public static void Stop(int limitMs)
        {
            Shim.Check(Shim.clk_jvm_stop(limitMs));
        }

        private static byte* Text(List<IntPtr> strings, string text)
        {
            var memory = Utf8.Allocate(text);
            strings.Add((IntPtr)memory);
            return memory;
        }
    }
}
