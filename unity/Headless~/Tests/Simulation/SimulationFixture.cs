using System;
using System.Collections.Generic;
using Collektive.Unity;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>A fixture with a new scene of probe nodes for each test, and with a real JVM.</summary>
    public abstract class SimulationFixture
    {
        private readonly List<string> errors = new List<string>();

        protected SimulationManager Manager { get; private set; }

        /// <summary>The messages that were logged as errors since the test began.</summary>
        protected IReadOnlyList<string> Errors => errors;

        /// <summary>The logged messages of any kind.</summary>
        protected List<string> Log { get; } = new List<string>();

        [SetUp]
        public void StartPlaying()
        {
            Loop.Reset();
            errors.Clear();
            Log.Clear();
            Application.logMessageReceivedThreaded += Keep;
            Installation.HostJar = TestJvm.HostJar;
            Installation.JavaHome = TestJvm.Home;
            Loop.Start(1);
            Manager = MakeManager("double");
        }

        [TearDown]
        public void StopPlaying()
        {
            Loop.Quit();
            Application.logMessageReceivedThreaded -= Keep;
        }

        protected SimulationManager MakeManager(string program, Action<SimulationSettings> change = null)
        {
            var manager = new GameObject("Simulation Manager").AddComponent<SimulationManager>();
            Configure(manager, program, change);
            return manager;
        }

        /// <summary>Changes the manager's settings before the first frame.</summary>
        protected void Configure(string program, Action<SimulationSettings> change = null) => Configure(Manager, program, change);

        private static void Configure(SimulationManager manager, string program, Action<SimulationSettings> change)
        {
            var settings = manager.Settings;
            settings.schema = "probe.ProbeSchema";
            settings.jars = new List<string> { TestJvm.Variable("COLLEKTIVE_PROBE_JAR") };
            settings.program = program;
            settings.deltaTime = 0.05f;
            settings.jvm = ScriptableObject.CreateInstance<JvmSettingsAsset>();
            settings.jvm.settings = TestJvm.Settings;
            change?.Invoke(settings);
            // The manager is disabled during the change, because a new seed takes effect when the manager is enabled.
            manager.enabled = false;
            manager.enabled = true;
        }

        protected static ProbeNode MakeNode(float value, Vector3 place = default, int id = -1)
        {
            var holder = new GameObject("Probe");
            holder.SetActive(false);
            holder.transform.position = place;
            var node = holder.AddComponent<Node>();
            node.RequestedId = id;
            var sensor = holder.AddComponent<ProbeSensor>();
            sensor.Value = value;
            var actuator = holder.AddComponent<ProbeActuator>();
            holder.SetActive(true);
            return new ProbeNode(node, sensor, actuator);
        }

        /// <summary>Plays a number of frames, each of which runs one tick.</summary>
        protected void Play(int ticks)
        {
            for (var i = 0; i < ticks; i++) Loop.Frame(Manager.Settings.deltaTime);
        }

        private void Keep(string message, string stack, LogType type)
        {
            // Threads of the JVM log messages, too.
            lock (errors)
            {
                Log.Add(message);
                if (type == LogType.Error || type == LogType.Exception) errors.Add(message);
            }
        }
    }

    /// <summary>A test node with its components.</summary>
    public sealed class ProbeNode
    {
        public ProbeNode(Node node, ProbeSensor sensor, ProbeActuator actuator)
        {
            Node = node;
            Sensor = sensor;
            Actuator = actuator;
        }

        public Node Node { get; }

        public ProbeSensor Sensor { get; }

        public ProbeActuator Actuator { get; }

        public float Answer => Actuator.Last.Value;
    }
}
