using Collektive.Bridge;
using Collektive.Headless.Tests.Simulation;
using Collektive.Unity;
using UnityEngine;
using UnityEngine.Headless;
using Object = UnityEngine.Object;

namespace Collektive.Headless.Soak
{
    /// <summary>
    /// A crowd of nodes, a few of which leave in each tick while others come. Half of those that come fail, in their program or in a sensor, until they
    /// leave; links come and go with them.
    /// </summary>
    internal sealed class Churn
    {
        private const int Nodes = 100;
        private const int PerTick = 10;
        private const int Kinds = 4;

        /// <summary>Ids are used again after this many: arrays are as long as the largest id.</summary>
        private const int Ids = 100000;

        private const int LimitMs = 30000;
        private static readonly string[] JvmOptions = { "-Xms96m", "-Xmx96m", "-XX:+UseSerialGC", "-XX:+AlwaysPreTouch" };

        private readonly SimulationManager manager;
        private readonly GameObject[] crowd = new GameObject[Nodes];
        private int made;
        private int sessions;

        internal Churn(string home, string host, string jar)
        {
            // Thousands of errors a second would be the run's output.
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
            for (var i = 0; i < Nodes; i++) crowd[i] = MakeNode();
        }

        internal string Failure => manager.Failure;

        internal string Summary =>
            manager.Tick + " ticks, " + made + " nodes, " + manager.ErrorCount + " errors in " + manager.Errors.Count + " places, " + sessions + " sessions";

        /// <summary>One tick, and before it some leave and as many come.</summary>
        internal void Frame()
        {
            for (var i = 0; i < PerTick; i++)
            {
                var place = made % Nodes;
                Object.Destroy(crowd[place]);
                crowd[place] = MakeNode();
                Link(place, (place + 1) % Nodes);
                Link(place, (place + Nodes / 2) % Nodes);
            }
            Loop.Frame(manager.Settings.deltaTime);
        }

        /// <summary>Enters and leaves play mode: a session with its own programs.</summary>
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

        private void Link(int a, int b) => manager.AddLink(crowd[a].GetComponent<Node>().Id, crowd[b].GetComponent<Node>().Id);

        private GameObject MakeNode()
        {
            var kind = made++ % Kinds;
            var holder = new GameObject("Node");
            holder.SetActive(false);
            holder.transform.position = new Vector3(made % Nodes, 0, 0);
            var node = holder.AddComponent<Node>();
            node.RequestedId = made % Ids;
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
