using System.Runtime.CompilerServices;

namespace UnityEngine
{
    /// Checks objects whose members throw an exception after their destruction. GameObject and Transform have faster properties, because Mono does not inline
    /// generic methods.
    static class Existence
    {
        /// Returns this object. Throws an exception if it is destroyed.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        internal static T Existing<T>(this T checkedObject) where T : Object
        {
            checkedObject.ThrowIfDestroyed();
            return checkedObject;
        }
    }
}
