using System;
using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>The C ABI of <c>collektive_shim</c>; its header holds the contracts.</summary>
    internal static unsafe class Shim
    {
        /// <summary>Major version of the header that this file was written from.</summary>
        internal const uint Major = 0;

        private const string Library = "collektive_shim";

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

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint clk_version();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* clk_error_text(int code);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_last_error(byte* buffer, int capacity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_jvm_start(JvmConfig* config);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_jvm_check(JvmConfig* config);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_jvm_state();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_jvm_description(byte* buffer, int capacity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_jvm_stop(int limitMs);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_slot_acquire(int capacity, ulong* slot, Memory* memory);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_slot_grow(ulong slot, int capacity, int keep, Memory* memory);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_slot_release(ulong slot);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_session_open(
            ulong slot, int offset, int length, int limitMs, ulong* session, Answer* answer);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_step(
            ulong session, ulong slot, int offset, int length, int limitMs, Answer* answer);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_session_close(ulong session, int limitMs);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_control(ulong slot, int offset, int length, int limitMs, Answer* answer);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_log_read(int* level, byte* buffer, int capacity);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int clk_get_stats(Stats* stats);

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
