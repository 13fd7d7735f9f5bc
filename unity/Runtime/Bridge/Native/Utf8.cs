using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Collektive.Bridge
{
    /// <summary>Text across the C ABI: UTF-8, ended by NUL. Not for per-tick code.</summary>
    internal static unsafe class Utf8
    {
        internal delegate int Copy(IntPtr buffer, int capacity);

        /// <summary>Native memory with <paramref name="text"/>, to be freed with <see cref="Marshal.FreeHGlobal"/>.</summary>
        internal static byte* Allocate(string text)
        {
            var bytes = Encoding.UTF8.GetBytes(text);
            var memory = (byte*)Marshal.AllocHGlobal(bytes.Length + 1);
            Marshal.Copy(bytes, 0, (IntPtr)memory, bytes.Length);
            memory[bytes.Length] = 0;
            return memory;
        }

        internal static string Decode(byte* text)
        {
            if (text == null) return "";
            var length = 0;
            while (text[length] != 0) length++;
            return Encoding.UTF8.GetString(text, length);
        }

        /// <summary>The whole text of a function that copies to a buffer and returns the length it would need.</summary>
        internal static string Copied(Copy copy)
        {
            var length = copy(IntPtr.Zero, 0);
            if (length <= 0) return "";
            var memory = Marshal.AllocHGlobal(length + 1);
            try
            {
                copy(memory, length + 1);
                return Decode((byte*)memory);
            }
            finally
            {
                Marshal.FreeHGlobal(memory);
            }
        }
    }
}
