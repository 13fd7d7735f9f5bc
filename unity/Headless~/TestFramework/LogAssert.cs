using System.Collections.Generic;
using System.Text.RegularExpressions;

namespace UnityEngine.TestTools
{
    /// A test fails if an unexpected error, exception or failed assertion is logged, or if an expected message is missing.
    public static class LogAssert
    {
        struct Expectation
        {
            internal LogType Type;
            internal Regex Message;
            internal string Text;

            internal bool Matches(string message, LogType type) => type == Type && (Message == null ? message == Text : Message.IsMatch(message));
        }

        static readonly List<Expectation> Expected = new List<Expectation>();
        static readonly List<string> Unexpected = new List<string>();

        public static bool ignoreFailingMessages { get; set; }

        public static void Expect(LogType type, string message) => Expected.Add(new Expectation { Type = type, Text = message });
        public static void Expect(LogType type, Regex message) => Expected.Add(new Expectation { Type = type, Message = message, Text = message.ToString() });

        public static void NoUnexpectedReceived()
        {
            if (Unexpected.Count > 0) throw new LogAssertException("unexpected in the log: " + string.Join("\n", Unexpected));
        }

        /// Begins a test. For the runner.
        public static void Begin()
        {
            Expected.Clear();
            Unexpected.Clear();
            ignoreFailingMessages = false;
            Application.logMessageReceivedThreaded += Receive;
        }

        /// Ends a test. For the runner.
        public static void End()
        {
            Application.logMessageReceivedThreaded -= Receive;
            if (Expected.Count > 0) throw new LogAssertException("missing from the log: " + Expected[0].Type + ": " + Expected[0].Text);
            NoUnexpectedReceived();
        }

        static void Receive(string message, string stack, LogType type)
        {
            lock (Expected)
            {
                var index = Expected.FindIndex(expectation => expectation.Matches(message, type));
                if (index >= 0) Expected.RemoveAt(index);
                else if (type != LogType.Log && type != LogType.Warning && !ignoreFailingMessages) Unexpected.Add(type + ": " + message);
            }
        }
    }

    public sealed class LogAssertException : System.Exception
    {
        internal LogAssertException(string message) : base(message) { }
    }
}
