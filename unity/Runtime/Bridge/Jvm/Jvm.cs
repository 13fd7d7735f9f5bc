using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>State of the process's JVM.</summary>
    public enum JvmState
    {
        /// <summary>Not started in this process.</summary>
        None = 0,
        /// <summary>Running.</summary>
        Running = 1,
        /// <summary>Exited, aborted or not responding. Only a JVM in a separate process can be replaced.</summary>
        Lost = 2,
        /// <summary>Shut down. Only a JVM in a separate process can be replaced.</summary>
        Stopped = 3,
    }

    /// <summary>
    /// The JVM of this process. It outlives sessions and play mode, and is still running when Unity reloads the C# domain. A process can start only one JVM
    /// inside itself; a JVM in a separate process can be replaced. All members may be called from any thread.
    /// </summary>
    public static unsafe class Jvm
    {
        /// <summary>The current state; <see cref="JvmState.None"/> if the native library cannot be used. Never blocks.</summary>
        public static JvmState State => ShimLibrary.Problem == null ? (JvmState)Shim.clk_jvm_state() : JvmState.None;

        /// <summary>Home, version and options of the JVM, one per line; empty before the JVM starts.</summary>
        internal static string Description =>
            State == JvmState.None ? "" : Shim.Text((buffer, capacity) => Shim.clk_jvm_description((byte*)buffer, capacity));

        /// <summary>Number of steps that the JVM received from all sessions since this process started.</summary>
        internal static ulong StepCalls => Stats.Steps;

        /// <summary>Process id of the last JVM in a separate process, running or not; 0 if it ran in this process or none was started.</summary>
        internal static int Process => Stats.Process;

        /// <summary>When changed settings take effect, for messages.</summary>
        internal static string WhenChangesTakeEffect => Process != 0 ? "at the next Play" : "after a restart of the editor";

        private static Shim.Stats Stats
        {
            get
            {
                var stats = new Shim.Stats { Size = (uint)sizeof(Shim.Stats) };
                if (State != JvmState.None) Shim.Check(Shim.clk_get_stats(&stats));
                return stats;
            }
        }

        /// <summary>
        /// Returns the reason why the native library cannot be used, with the platform and the fix, or null if the library is usable. The library may be
        /// missing, of another version, or built for another platform.
        /// </summary>
        internal static string FindProblem() => ShimLibrary.Problem;

        /// <summary>
        /// Starts the JVM, or does nothing if it already runs with the same options. A JVM in a separate process is replaced if it has no session.
        /// </summary>
        /// <exception cref="BridgeException">The JVM, its options or the host's jar are not usable.</exception>
        internal static void Start(JvmLaunch launch)
        {
            ShimLibrary.Check();
            lock (JvmControl.Gate) Configured(launch, config => Shim.clk_jvm_start((Shim.JvmConfig*)config));
        }

        /// <summary>
        /// Runs the checks of <see cref="Start"/>. It checks the files, rejects unsupported options, and starts a JVM with the options in a child process
        /// (50 to 200 ms). <see cref="Start"/> does not try accepted options again.
        /// </summary>
        /// <exception cref="BridgeException">The JVM, its options or the host's jar are not usable.</exception>
        internal static void Check(JvmLaunch launch)
        {
            ShimLibrary.Check();
            Configured(launch, config => Shim.clk_jvm_check((Shim.JvmConfig*)config));
        }

        /// <summary>Returns the status of the running JVM. Takes a few milliseconds, about 50 the first time, and up to 10 s while a tick runs.</summary>
        /// <param name="collect">Whether to collect garbage first, so that only live objects are counted.</param>
        /// <exception cref="BridgeException">No JVM is running.</exception>
        public static JvmStatus GetStatus(bool collect = false) => JvmControl.Send(new JvmControl.Query { Collect = collect });

        /// <summary>Returns the same as <see cref="GetStatus"/>, or null if no JVM runs or a debugger has stopped it.</summary>
        internal static JvmStatus TryGetStatus()
        {
            try
            {
                return State == JvmState.Running ? GetStatus() : null;
            }
            catch (BridgeException error) when (error.Error == BridgeError.JvmLost || error.Error == BridgeError.JvmNotRunning
                || error.Error == BridgeError.Timeout)
            {
                return null;
            }
        }

        private static void Configured(JvmLaunch launch, Func<IntPtr, int> call)
        {
            var strings = new List<IntPtr>();
            var options = launch.Options;
            var pointers = stackalloc byte*[options.Count + 1];
            try
            {
                for (var i = 0; i < options.Count; i++) pointers[i] = Text(strings, options[i]);
                var config = new Shim.JvmConfig
                {
                    Size = (uint)sizeof(Shim.JvmConfig),
                    OptionCount = options.Count,
                    Home = Text(strings, launch.Home),
                    ClassPath = Text(strings, launch.ClassPath),
                    Options = pointers,
                    StartLimitMs = launch.StartLimitMs,
                    CheckOptions = 1,
                    Placement = (int)launch.Placement,
                };
                Shim.Check(call((IntPtr)(&config)));
            }
            finally
            {
                foreach (var memory in strings) Marshal.FreeCoTaskMem(memory);
            }
        }

        /// <summary>Shuts the JVM down, if one was started. Afterwards, this process can only start a JVM in a separate process.</summary>
        /// <exception cref="BridgeException">The JVM did not exit within <paramref name="limitMs"/> milliseconds.</exception>
        internal static void Stop(int limitMs)
        {
            if (ShimLibrary.Problem != null) return;
            lock (JvmControl.Gate) Shim.Check(Shim.clk_jvm_stop(limitMs));
        }

        private static byte* Text(List<IntPtr> strings, string text)
        {
            var memory = Marshal.StringToCoTaskMemUTF8(text);
            strings.Add(memory);
            return (byte*)memory;
        }
    }
}
