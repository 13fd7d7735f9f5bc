using System;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Collektive.Headless
{
    /// <summary>Passes on all log messages except that of a stopped simulation, because the run ends with the same text.</summary>
    internal sealed class RunLog : ILogHandler
    {
        private readonly ILogHandler inner;

        private RunLog(ILogHandler inner) => this.inner = inner;

        /// <summary>Installs this filter for all later messages.</summary>
        internal static void Install() => Debug.unityLogger.logHandler = new RunLog(Debug.unityLogger.logHandler);

        public void LogFormat(LogType logType, Object context, string format, params object[] args)
        {
            var isStop = logType == LogType.Error && args.Length == 1 && args[0] is string text
                && text.StartsWith(Collektive.Unity.Simulation.StopPrefix, StringComparison.Ordinal);
            if (!isStop) inner.LogFormat(logType, context, format, args);
        }

        public void LogException(Exception exception, Object context) => inner.LogException(exception, context);
    }
}
