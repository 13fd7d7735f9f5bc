using System;
using System.ComponentModel;

namespace Collektive.Bridge
{
    /// <summary>Checks at start-up that mirrors have the layout of the schema. Used by generated code.</summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public static class MirrorLayout
    {
        /// <summary>Throws if a mirror has another size.</summary>
        public static unsafe void Size<T>(int expected) where T : unmanaged
        {
            if (sizeof(T) != expected) throw Wrong<T>("has " + sizeof(T) + " bytes, not " + expected);
        }

        /// <summary>Throws if a field of a mirror has another offset.</summary>
        public static unsafe void Offset<T, TField>(ref T mirror, ref TField field, int expected)
            where T : unmanaged where TField : unmanaged
        {
            fixed (T* start = &mirror)
            fixed (TField* place = &field)
            {
                var offset = (byte*)place - (byte*)start;
                if (offset != expected) throw Wrong<T>("has a field at offset " + offset + ", not " + expected);
            }
        }

        private static InvalidOperationException Wrong<T>(string what) => new InvalidOperationException(
            typeof(T).FullName + " " + what + ": the struct layout of this C# runtime differs from the schema; report an issue with the name of the platform");
    }
}
