using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Engine
{
    /// A fixture with a new player for each test. Scripts record the messages that they receive in `Notes`.
    public abstract class PlayerFixture
    {
        public static readonly List<string> Notes = new List<string>();

        protected static readonly List<string> Errors = new List<string>();

        [SetUp]
        public void StartPlayer()
        {
            Loop.Reset();
            Debug.unityLogger.logHandler = new Recorder();
            Loop.Start(1);
            Notes.Clear();
            Errors.Clear();
        }

        [TearDown]
        public void ResetPlayer() => Loop.Reset();

        protected static string Events() => string.Join(" ", Notes);

        protected static T Add<T>(string name = "object") where T : Component => new GameObject(name).AddComponent<T>();

        sealed class Recorder : ILogHandler
        {
            public void LogFormat(LogType logType, UnityEngine.Object context, string format, params object[] args) => Errors.Add(string.Format(format, args));
            public void LogException(System.Exception exception, UnityEngine.Object context) => Errors.Add(exception.Message);
        }
    }
}
