using System;
using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>Global data for the next tick. It is written once the session is open.</summary>
    internal sealed class SceneGlobals
    {
        private Func<GlobalBuffer, string> pending;

        internal void Set<T>(Action<T> write)
        {
            var earlier = pending;
            pending = buffer => earlier?.Invoke(buffer) ?? Write(buffer, write);
        }

        internal void Clear() => pending = null;

        /// <summary>Writes the data set since the last tick to the request, and returns its error or null.</summary>
        internal string Flush(StepRequest request)
        {
            if (pending == null) return null;
            var write = pending;
            pending = null;
            request.GlobalsChanged = true;
            return write(request.Globals);
        }

        private static string Write<T>(GlobalBuffer buffer, Action<T> write)
        {
            if (buffer == null) return "global data was set, but the session's schema has no GlobalData: add it to the schema";
            if (!(buffer is GlobalBuffer<T> typed))
                return "global data was set as " + typeof(T).FullName + ", but the session's schema has " + buffer.DataType.FullName
                    + ": set data of that type";
            write(typed.Data);
            var field = buffer.FindNotFinite();
            return field == null ? null : "global data contains a number that is not finite in " + field + ": fix the script that sets it";
        }
    }
}
