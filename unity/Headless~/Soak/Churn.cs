using Collektive.Bridge;
using Collektive.Headless.Tests.Simulation;
using Collektive.Unity;
using UnityEngine;
using UnityEngine.Headless;
using Object = UnityEngine.Object;

namespace Collektive.Headless.Soak
{
    /// <summary>
    /// Nodes of which a few leave in each tick while others join. Half of the new nodes fail, in their program or in a sensor, until they leave. Links
    /// appear and disappear with them.
    /// </summary>
    internal sealed class Churn
    {
        private const int Nodes = 100;
        private const int PerTick = 10;
        private const int Kinds = 4;

        /// <summary>Number of ids before they are reused, because arrays are as long as the largest id.</summary>
        private const int Ids = 100000;

        private const int LimitMs = 30000;
        private static readonly string[] JvmOptions = { "-Xms96m", "-Xmx96m", "-XX:+UseSerialGC", "-XX:+AlwaysPreTouch" };

        private readonly SimulationManager manager;
        private readonly GameObject[] holders = new GameObject[Nodes];
        private int created;
        private int sessions;

        internal Churn(string home, string host, string jar)
        {
            // Do not print thousands of errors per second.
            Debug.unityLogger.logEnabled = false;
            Installation.JavaHome = home;
            Installation.HostJar = host;
            manager = new GameObject("Simulation Manager").AddComponent<SimulationManager>();
            var settings = manager.Settings;
            settings.schema = "probe.ProbeSchema";
            settings.jars.Add(jar);
            settings.program = "fault";
            settings.stepLimitMs = LimitMs;
            settings.jvm = ScriptableObject.CreateInstance<JvmSettingsAsset>();
            settings.jvm.settings.cdsArchive = false;
            settings.jvm.settings.flags.AddRange(JvmOptions);
            for (var i = 0; i < Nodes; i++) holders[i] = MakeNode();
        }

        internal string Failure => manager.Failure;

        internal string Summary =>
            manager.Tick + " ticks, " + created + " nodes, " + manager.ErrorCount + " errors in " + manager.Errors.Count + " places, " + sessions + " sessions";

        /// <summary>Replaces some nodes, then runs one tick.</summary>
        internal void Frame()
        {
            for (var i = 0; i < PerTick; i++)
            {
                var place = created % Nodes;
                Object.Destroy(holders[place]);
                holders[place] = MakeNode();
                Link(place, (place + 1) % Nodes);
                Link(place, (place + Nodes / 2) % Nodes);
            }
            Loop.Frame(manager.Settings.deltaTime);
        }

        /// <summary>Opens and closes a session with its own programs, as play mode does.</summary>
        internal void PlaySession()
        {
            var settings = new SessionSettings { Jars = new[] { manager.Settings.jars[0] }, Program = "fault" };
            using (var session = Session.Open(settings, new probe.ProbeSchema()))
            {
                session.Request.AddNode(1, "", null);
                session.Request.Sensors.EnsureCapacity(1);
                session.Request.AddDue(1);
                session.Step(manager.Settings.deltaTime, LimitMs);
            }
            sessions++;
        }

        private void Link(int a, int b) => manager.AddLink(holders[a].GetComponent<Node>().Id, holders[b].GetComponent<Node>().Id);

        private GameObject MakeNode()
        {
            var kind = created++ % Kinds;
            var holder = new GameObject("Node");
            holder.SetActive(false);
            holder.transform.position = new Vector3(created % Nodes, 0, 0);
            var node = holder.AddComponent<Node>();
            node.RequestedId = created % Ids;
            node.Parameters.Add(new NodeParameter("fault", "throw"));
            holder.AddComponent<ProbeSensor>().Value = kind == 0 ? 1 : 0;
            if (kind == 1) holder.AddComponent<BrokenSensor>();
            holder.AddComponent<ProbeActuator>();
            holder.SetActive(true);
            return holder;
        }

        private sealed class BrokenSensor : Sensor<probe.SensorData>
        {
            protected override void Sense(ref probe.SensorData data) =>
                throw new System.InvalidOperationException("node " + Node.Id + " senses nothing at " + transform.position);
        }
    }
}
