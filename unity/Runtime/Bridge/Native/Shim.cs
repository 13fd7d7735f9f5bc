using System;
using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>
    /// The C ABI of <c>collektive_shim</c>; its header holds the contracts. Whoever makes the first call asks <see cref="ShimLibrary"/> whether
    /// the library is there.
    /// </summary>
    internal static unsafe partial class Shim
    {
        /// <summary>Major version of the header that this file was written from.</summary>
        internal const uint Major = 0;

        [StructLayout(LayoutKind.Sequential)]
        internal struct JvmConfig
        {
            public uint Size;
            public int OptionCount;
            public byte* Home;
            public byte* ClassPath;
            public byte** Options;
            public int StartLimitMs;
            public int CheckOptions;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct Memory
        {
            public uint Size;
            public int Capacity;
            public byte* Address;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct Answer
        {
            public uint Size;
            public int Offset;
            public int Length;
            public int Capacity;
            public byte* Address;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct Stats
        {
            public uint Size;
            public int Sessions;
            public int Slots;
            public int Reserved;
            public ulong Steps;
            public ulong SlotBytes;
            public ulong Wrapped;
            public ulong LogsDropped;
            public ulong SignalRepairs;
        }

        /// <summary>Throws the calling thread's last error unless <paramref name="code"/> is success.</summary>
        internal static void Check(int code)
        {
            if (code < 0) throw new BridgeException((BridgeError)code, LastError(code));
        }

        private static string LastError(int code)
        {
            var text = Utf8.Copied((buffer, capacity) => clk_last_error((byte*)buffer, capacity));
            return text.Length > 0 ? text : Utf8.Decode(clk_error_text(code));
        }
    }
}
