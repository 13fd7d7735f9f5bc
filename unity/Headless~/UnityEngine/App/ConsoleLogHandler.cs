using System;
using System.Globalization;

namespace UnityEngine
{
    /// The player's log: messages to standard output, warnings and worse to standard error.
    sealed class ConsoleLogHandler : ILogHandler
    {
        public void LogFormat(LogType logType, Object context, string format, params object[] args)
        {
            var message = args.Length == 0 ? format : string.Format(CultureInfo.InvariantCulture, format, args);
            Write(logType, message, "");
        }

        public void LogException(Exception exception, Object context)
        {
            var message = exception.GetType().Name + ": " + exception.Message;
            Write(LogType.Exception, message, exception.ToString());
        }

        static void Write(LogType type, string message, string details)
        {
            if (type == LogType.Log) Console.Out.WriteLine(message);
            else Console.Error.WriteLine(details.Length == 0 ? message : details);
            Application.RaiseLog(message, details, type);
        }
    }
}
