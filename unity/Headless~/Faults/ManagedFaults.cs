using System;
using System.Runtime.InteropServices;
using Collektive.Bridge;
using Collektive.Unity;
using UnityEngine;

namespace Collektive.Headless.Faults
{
    /// <summary>Faults in C# and in native libraries.</summary>
    internal static class ManagedFaults
    {
        private const int SegmentationFault = 11;
        private const int KillSignal = 9;

        internal static void Run(string act, SimulationManager manager, Component node)
        {
            switch (act)
            {
                case "none": break;
                case "take-sigsegv": signal(SegmentationFault, IntPtr.Zero); break;
                case "sensor-null": node.gameObject.AddComponent<NullSensor>(); break;
                case "sensor-divides": node.gameObject.AddComponent<DividingSensor>(); break;
                case "unknown-node": SendUnknownNode(manager); break;
                case "other-options": StartWithOtherOptions(); break;
                case "kill-jvm": kill(Jvm.Process, KillSignal); break;
                case "record-nowhere": JvmRecording.Start("/proc/nowhere/record.jfr"); break;
                default: throw new ArgumentException("unknown act '" + act + "'");
            }
        }

        /// <summary>Raises exceptions that are implemented by signals, and runs a collection.</summary>
        internal static bool CSharpWorks()
        {
            var caught = 0;
            for (var i = 0; i < 100; i++)
            {
                try
                {
                    if (i % 2 == 0) Text(null);
                    else Divide(i, 0);
                }
                catch (Exception error) when (error is NullReferenceException || error is DivideByZeroException)
                {
                    caught++;
                }
                GC.KeepAlive(new byte[100000]);
            }
            GC.Collect();
            return caught == 100;
        }

        private static int Text(string text) => text.Length;

        private static int Divide(int a, int b) => a / b;

        private static void SendUnknownNode(SimulationManager manager)
        {
            var settings = new SessionSettings { Jars = new[] { manager.Settings.jars[0] }, Program = "fault" };
            using (var session = Session.Open(settings, new probe.ProbeSchema()))
            {
                session.Request.SetLink(new LinkRecord { From = 1, To = 77 });
                try
                {
                    session.Step(0.05, 1000);
                }
                catch (BridgeException error)
                {
                    Debug.LogError(error.Message);
                }
            }
        }

        private static void StartWithOtherOptions()
        {
            try
            {
                Jvm.Start(new JvmLaunch(Installation.JavaHome, Installation.HostJar, new[] { "-Xmx99m" }) { Placement = Scene.Placement });
            }
            catch (BridgeException error)
            {
                Debug.LogError(error.Message);
            }
        }

        [DllImport("libc", ExactSpelling = true)]
        private static extern int kill(int process, int number);

        [DllImport("libc", ExactSpelling = true)]
        private static extern IntPtr signal(int number, IntPtr handler);

        private sealed class NullSensor : Sensor<probe.SensorData>
        {
            protected override void Sense(ref probe.SensorData data)
            {
                enabled = false;
                Text(null);
            }
        }

        private sealed class DividingSensor : Sensor<probe.SensorData>
        {
            protected override void Sense(ref probe.SensorData data)
            {
                enabled = false;
                Divide(1, 0);
            }
        }
    }
}
