using System;
using System.Collections.Generic;
using Collektive.Bridge;

namespace Collektive.Unity
{
    /// <summary>Collects global data for the next tick. The data is written once the session is open.</summary>
    internal sealed class SceneGlobals
    {
        private List<Func<GlobalBuffer, string>> pending = new List<Func<GlobalBuffer, string>>();
        private List<Func<GlobalBuffer, string>> writing = new List<Func<GlobalBuffer, string>>();

        internal void Set<T>(Action<T> write) => pending.Add(buffer => Write(buffer, write));

        internal void Clear()
        {
            pending.Clear();
            // Contains data if the user's code has thrown an exception.
            writing.Clear();
        }

        /// <summary>Writes the data that was set since the last tick to the request. Returns the error of the data, or null.</summary>
        internal string Flush(StepRequest request)
        {
            if (pending.Count == 0) return null;
            // The user's code may set more data here, for the next tick.
            (pending, writing) = (writing, pending);
            request.GlobalsChanged = true;
            string problem = null;
            for (var i = 0; i < writing.Count && problem == null; i++) problem = writing[i](request.Globals);
            writing.Clear();
            return problem;
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
