using System;

namespace UnityEngine
{
    public class Debug
    {
        static readonly Logger Default = new Logger(new ConsoleLogHandler());

        public static ILogger unityLogger => Default;
        public static bool isDebugBuild => true;

        public static void Log(object message) => Default.Log(LogType.Log, message, null);
        public static void Log(object message, Object context) => Default.Log(LogType.Log, message, context);
        public static void LogFormat(string format, params object[] args) => Default.LogFormat(LogType.Log, null, format, args);
        public static void LogFormat(Object context, string format, params object[] args) => Default.LogFormat(LogType.Log, context, format, args);
        public static void LogFormat(LogType logType, LogOption logOptions, Object context, string format, params object[] args) =>
            Default.LogFormat(logType, context, format, args);
        public static void LogWarning(object message) => Default.Log(LogType.Warning, message, null);
        public static void LogWarning(object message, Object context) => Default.Log(LogType.Warning, message, context);
        public static void LogWarningFormat(string format, params object[] args) => Default.LogFormat(LogType.Warning, null, format, args);
        public static void LogWarningFormat(Object context, string format, params object[] args) => Default.LogFormat(LogType.Warning, context, format, args);
        public static void LogError(object message) => Default.Log(LogType.Error, message, null);
        public static void LogError(object message, Object context) => Default.Log(LogType.Error, message, context);
        public static void LogErrorFormat(string format, params object[] args) => Default.LogFormat(LogType.Error, null, format, args);
        public static void LogErrorFormat(Object context, string format, params object[] args) => Default.LogFormat(LogType.Error, context, format, args);
        public static void LogException(Exception exception) => Default.LogException(exception, null);
        public static void LogException(Exception exception, Object context) => Default.LogException(exception, context);

        public static void Assert(bool condition) => Assert(condition, "Assertion failed", null);
        public static void Assert(bool condition, string message) => Assert(condition, message, null);

        public static void Assert(bool condition, string message, Object context)
        {
            if (!condition) Default.Log(LogType.Assert, (object)message, context);
        }

        // These methods do nothing, because this player does not draw.
        public static void DrawLine(Vector3 start, Vector3 end) { }
        public static void DrawLine(Vector3 start, Vector3 end, Color color) { }
        public static void DrawLine(Vector3 start, Vector3 end, Color color, float duration) { }
        public static void DrawRay(Vector3 start, Vector3 dir) { }
        public static void DrawRay(Vector3 start, Vector3 dir, Color color) { }
        public static void DrawRay(Vector3 start, Vector3 dir, Color color, float duration) { }

        internal static void ResetState()
        {
            Default.logHandler = new ConsoleLogHandler();
            Default.logEnabled = true;
            Default.filterLogType = LogType.Log;
        }
    }
}
