using System;
using System.Collections.Generic;
using Collektive.Bridge;
using Collektive.Headless.Tests.Simulation;
using Collektive.Unity;
using Collektive.Unity.Editor;
using UnityEditor;
using UnityEditor.Headless;
using UnityEngine;
using UnityEngine.Headless;
using Object = UnityEngine.Object;

namespace Collektive.Headless.WithoutLibrary
{
    /// <summary>
    /// Plays 50 frames, drawing each inspector and window in each of them, and quits. Prints "exceptions N, errors N, manager on|off", and then
    /// the errors. The argument is editor or player, which end differently.
    /// </summary>
    internal static class Program
    {
        private const int Frames = 50;

        private static readonly List<string> errors = new List<string>();
        private static int exceptions;

        private static int Main(string[] arguments)
        {
            Application.logMessageReceivedThreaded += Count;
            Loop.IsEditor = arguments[0] == "editor";
            EditorApplication.isPlaying = Loop.IsEditor;
            Loop.Start(1);
            var manager = new GameObject("Simulation Manager").AddComponent<SimulationManager>();
            manager.Settings.jars.Add("programs.jar");
            manager.Settings.jvm = ScriptableObject.CreateInstance<JvmSettingsAsset>();
            for (var i = 0; i < 3; i++) MakeNode();
            for (var i = 0; i < Frames; i++)
            {
                Loop.Frame(0.05f);
                if (Loop.IsEditor) LogExceptions(() => Draw(manager));
            }
            var isOn = manager.enabled;
            if (Loop.IsEditor) LogExceptions(() => DiagnosticsWindow.Open().Close());
            Loop.Quit();
            LogExceptions(() => Jvm.Stop(1000));
            Console.WriteLine("exceptions " + exceptions + ", errors " + errors.Count + ", manager " + (isOn ? "on" : "off"));
            foreach (var error in errors) Console.WriteLine(error);
            return 0;
        }

        private static void MakeNode()
        {
            var node = new GameObject("Node");
            node.AddComponent<Node>();
            node.AddComponent<ProbeSensor>();
            node.AddComponent<ProbeActuator>();
        }

        private static void Draw(SimulationManager manager)
        {
            Gui.Clear();
            Gui.Act("JVM settings", true);
            Gui.Passes(UnityEditor.Editor.CreateEditor(manager).OnInspectorGUI);
            Gui.Passes(UnityEditor.Editor.CreateEditor(manager.Settings.jvm).OnInspectorGUI);
            for (var tab = 0; tab < 5; tab++)
            {
                Gui.Act("toolbar", tab);
                Menus.Draw(DiagnosticsWindow.Open());
            }
        }

        /// <summary>Calls inspectors, windows and handlers as the editor does, which logs their exceptions.</summary>
        private static void LogExceptions(Action action)
        {
            try
            {
                action();
            }
            catch (Exception error)
            {
                Debug.LogException(error);
            }
        }

        private static void Count(string message, string stack, LogType type)
        {
            lock (errors)
            {
                if (type == LogType.Exception) exceptions++;
                if (type == LogType.Error || type == LogType.Exception) errors.Add(message);
            }
        }
    }
}
