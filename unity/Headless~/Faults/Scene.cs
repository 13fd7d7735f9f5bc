using Collektive.Bridge;
using Collektive.Headless.Tests.Simulation;
using Collektive.Unity;
using UnityEngine;
using UnityEngine.Headless;

namespace Collektive.Headless.Faults
{
    /// <summary>Two nodes that count their rounds; the second one causes the fault.</summary>
    internal sealed class Scene
    {
        /// <summary>Placement of the JVMs of all scenes.</summary>
        internal static JvmPlacement Placement;

        private readonly SimulationManager manager;
        private readonly ProbeActuator good;
        private readonly ProbeActuator bad;
        private readonly ProbeSensor trigger;

        internal Scene(Setting setting, string fault, int limitMs)
        {
            manager = MakeManager(setting);
            manager.Settings.stepLimitMs = limitMs;
            good = MakeNode("none", out _);
            bad = MakeNode(fault, out trigger);
        }

        internal static SimulationManager MakeManager(Setting setting)
        {
            Installation.JavaHome = setting.Home;
            Installation.HostJar = setting.Host;
            var manager = new GameObject("Simulation Manager").AddComponent<SimulationManager>();
            manager.Settings.schema = "probe.ProbeSchema";
            manager.Settings.jars.Add(setting.Jar);
            manager.Settings.program = "fault";
            manager.Settings.jvm = ScriptableObject.CreateInstance<JvmSettingsAsset>();
            manager.Settings.jvm.settings.cdsArchive = false;
            manager.Settings.jvm.settings.placement = Placement;
            manager.Settings.jvm.settings.flags.AddRange(setting.Options);
            return manager;
        }

        /// <summary>Whether the nodes' rounds continue after the fault.</summary>
        internal bool Play(string act)
        {
            Frames(3);
            if (manager.Failure.Length > 0 || good.Last.Value != 3 || bad.Last.Value != 3) return false;
            trigger.Value = 1;
            ManagedFaults.Run(act, manager, trigger);
            Frames(1);
            trigger.Value = 0;
            var before = (good.Last.Value, bad.Last.Value);
            Frames(2);
            return manager.Failure.Length == 0 && good.Last.Value == before.Item1 + 2 && bad.Last.Value == before.Item2 + 2;
        }

        private void Frames(int count)
        {
            for (var i = 0; i < count; i++) Loop.Frame(manager.Settings.deltaTime);
        }

        private static ProbeActuator MakeNode(string fault, out ProbeSensor sensor)
        {
            var holder = new GameObject("Node");
            holder.SetActive(false);
            holder.AddComponent<Node>().Parameters.Add(new NodeParameter("fault", fault));
            sensor = holder.AddComponent<ProbeSensor>();
            var actuator = holder.AddComponent<ProbeActuator>();
            holder.SetActive(true);
            return actuator;
        }
    }
}
