using System;
using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>Global data on their way to the next tick; written when the session is there.</summary>
    internal sealed class SceneGlobals
    {
        private Func<GlobalBuffer, string> pending;

        internal void Set<T>(Action<T> write)
        {
            var earlier = pending;
            pending = buffer => earlier?.Invoke(buffer) ?? Write(buffer, write);
        }

        internal void Clear() => pending = null;

        /// <summary>Writes into the request what was set since the last tick; what is wrong with it, or null.</summary>
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
                return "global data was set as " + typeof(T).FullName + ", but the session's schema has " + buffer.DataType.FullName;
            write(typed.Data);
            var field = buffer.FindNotFinite();
            return field == null ? null : "global data contains a number that is not finite in " + field;
        }
    }
}
