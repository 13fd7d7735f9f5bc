using System;

namespace Collektive.Bridge
{
    /// <summary>Proves at start-up that the runtime lays a mirror out as the schema does. Used by generated code.</summary>
    public static class MirrorLayout
    {
        /// <summary>Refuses a mirror of another size.</summary>
        public static unsafe void Size<T>(int expected) where T : unmanaged
        {
            if (sizeof(T) != expected) throw Wrong<T>("has " + sizeof(T) + " bytes, not " + expected);
        }

        /// <summary>Refuses a mirror with the field at another offset.</summary>
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
            typeof(T).FullName + " " + what + ": this C# runtime lays structs out differently from the schema");
    }
}
