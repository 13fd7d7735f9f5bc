using System;
using System.Globalization;

namespace UnityEngine
{
    public class Logger : ILogger
    {
        public Logger(ILogHandler logHandler) => this.logHandler = logHandler;

        public ILogHandler logHandler { get; set; }
        public bool logEnabled { get; set; } = true;
        public LogType filterLogType { get; set; } = LogType.Log;

        /// `filterLogType` is the least severe type that is logged. Exceptions are always logged.
        public bool IsLogTypeAllowed(LogType logType) =>
            logEnabled && (logType == LogType.Exception || filterLogType != LogType.Exception && logType <= filterLogType);

        public void Log(LogType logType, object message) => Log(logType, message, null);
        public void Log(LogType logType, string tag, object message) => Log(logType, tag, message, null);
        public void Log(object message) => Log(LogType.Log, message, null);
        public void Log(string tag, object message) => Log(LogType.Log, tag, message, null);
        public void Log(string tag, object message, Object context) => Log(LogType.Log, tag, message, context);
        public void LogWarning(string tag, object message) => Log(LogType.Warning, tag, message, null);
        public void LogWarning(string tag, object message, Object context) => Log(LogType.Warning, tag, message, context);
        public void LogError(string tag, object message) => Log(LogType.Error, tag, message, null);
        public void LogError(string tag, object message, Object context) => Log(LogType.Error, tag, message, context);
        public void LogFormat(LogType logType, string format, params object[] args) => LogFormat(logType, null, format, args);
        public void LogException(Exception exception) => LogException(exception, null);

        public void Log(LogType logType, object message, Object context)
        {
            if (IsLogTypeAllowed(logType)) logHandler.LogFormat(logType, context, "{0}", TextOf(message));
        }

        public void Log(LogType logType, string tag, object message, Object context)
        {
            if (IsLogTypeAllowed(logType)) logHandler.LogFormat(logType, context, "{0}: {1}", tag, TextOf(message));
        }

        public void LogFormat(LogType logType, Object context, string format, params object[] args)
        {
            if (IsLogTypeAllowed(logType)) logHandler.LogFormat(logType, context, format, args);
        }

        public void LogException(Exception exception, Object context)
        {
            if (logEnabled) logHandler.LogException(exception, context);
        }

        static string TextOf(object message)
        {
            if (message == null) return "Null";
            return message is IFormattable value ? value.ToString(null, CultureInfo.InvariantCulture) : message.ToString();
        }
    }
}
