using System;
using Collektive.Bridge;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Collektive.Unity
{
    /// <summary>Writes the JVM's log to Unity's console.</summary>
    internal sealed class JvmLog
    {
        private readonly HostLog log = new HostLog();
        private readonly Object context;

        /// <param name="context">The object that a click on a line selects.</param>
        internal JvmLog(Object context)
        {
            this.context = context;
        }

        /// <summary>Logs the new lines, and passes each one to <paramref name="shown"/>, which may be null.</summary>
        internal void Show(Action<HostLogLevel, string> shown)
        {
            while (log.TryRead(out var level, out var line)) Show(level, line, shown);
        }

        /// <summary>Logs the remaining lines, and then the number of omitted lines.</summary>
        internal void ShowRest(Action<HostLogLevel, string> shown)
        {
            Show(shown);
            if (log.TryCount(out var level, out var line)) Show(level, line, shown);
        }

        private void Show(HostLogLevel level, string line, Action<HostLogLevel, string> shown)
        {
            if (level == HostLogLevel.Error) Debug.LogError(line, context);
            else if (level == HostLogLevel.Warning) Debug.LogWarning(line, context);
            else Debug.Log(line, context);
            try
            {
                shown?.Invoke(level, line);
            }
            catch (Exception error)
            {
                // An exception in a user's handler must not end the frame.
                Debug.LogException(error, context);
            }
        }
    }
}
