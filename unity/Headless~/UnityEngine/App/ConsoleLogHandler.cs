using System;
using System.Globalization;

namespace UnityEngine
{
    /// Writes messages to standard output, and warnings and errors to standard error.
    sealed class ConsoleLogHandler : ILogHandler
    {
        const int MaxLines = 60;

        public void LogFormat(LogType logType, Object context, string format, params object[] args)
        {
            var message = args.Length == 0 ? format : string.Format(CultureInfo.InvariantCulture, format, args);
            Write(logType, message, "");
        }

        public void LogException(Exception exception, Object context)
        {
            var message = exception.GetType().Name + ": " + exception.Message;
            Write(LogType.Exception, message, Shortened(exception.ToString()));
        }

        /// Shortens stack traces, because an endless recursion produces thousands of lines.
        static string Shortened(string details)
        {
            var lines = details.Split('\n');
            if (lines.Length <= MaxLines) return details;
            return string.Join("\n", lines, 0, MaxLines / 2) + "\n  (" + (lines.Length - MaxLines) + " more lines)\n"
                + string.Join("\n", lines, lines.Length - MaxLines / 2, MaxLines / 2);
        }

        static void Write(LogType type, string message, string details)
        {
            if (type == LogType.Log) Console.Out.WriteLine(message);
            else Console.Error.WriteLine(details.Length == 0 ? message : details);
            Application.RaiseLog(message, details, type);
        }
    }
}
