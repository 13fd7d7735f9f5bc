using System;
using System.Runtime.InteropServices;

namespace Collektive.Bridge
{
    /// <summary>
    /// The C functions of <c>collektive_shim</c> and <c>collektive_neighbours</c>, which are in one library. Their C headers document them. Check <see
    /// cref="ShimLibrary"/> before the first call.
    /// </summary>
    internal static unsafe partial class Shim
    {
        /// <summary>Major version of the C header that the declarations below match.</summary>
        internal const uint Major = 0;

        /// <summary>The return code of a step that has not ended.</summary>
        internal const int Pending = 1;

        internal delegate int Copy(IntPtr buffer, int capacity);

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
            public int Placement;
            public int Reserved;
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
            public int Process;
            public ulong Steps;
            public ulong SlotBytes;
            public ulong Wrapped;
            public ulong LogsDropped;
            public ulong SignalRepairs;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct LinkChanges
        {
            public LinkRecord* Set;
            public LinkEnds* Removed;
            public int SetCount;
            public int RemovedCount;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct LinkPairs
        {
            public LinkPair* Pairs;
            public int Count;
            public int Capacity;
            public int Links;
        }

        /// <summary>Throws the calling thread's last error unless <paramref name="code"/> is success.</summary>
        internal static void Check(int code)
        {
            if (code < 0) throw new BridgeException((BridgeError)code, LastError(code));
        }

        /// <summary>Calls a function that copies UTF-8 to a buffer and returns the required length. Returns the full text. Allocates.</summary>
        internal static string Text(Copy copy)
        {
            var length = copy(IntPtr.Zero, 0);
            if (length <= 0) return "";
            var memory = Marshal.AllocHGlobal(length + 1);
            try
            {
                copy(memory, length + 1);
                return Marshal.PtrToStringUTF8(memory);
            }
            finally
            {
                Marshal.FreeHGlobal(memory);
            }
        }

        private static string LastError(int code)
        {
            var text = Text((buffer, capacity) => clk_last_error((byte*)buffer, capacity));
            return text.Length > 0 ? text : Marshal.PtrToStringUTF8((IntPtr)clk_error_text(code));
        }
    }
}
