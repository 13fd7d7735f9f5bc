using System.Collections.Generic;
using UnityEngine;

namespace Collektive.Unity.PublicApi.Tests
{
    // Typical user code. Only public members of the package are visible to this assembly, so it no longer compiles if one of them is removed or changed.

    internal sealed class UsersSensor : Sensor<float>
    {
        [InspectorReadOnly]
        [SerializeField]
        private float last;

        protected override void OnEnable()
        {
            base.OnEnable();
            last = Node.Id;
        }

        protected override void Sense(ref float data) => data = last = Node.Random.Range(0f, 1f) + transform.position.x;
    }

    internal sealed class UsersActuator : Actuator<float>
    {
        protected override void Act(float data) => transform.position = new Vector3(data, 0, 0);
    }

    internal sealed class UsersLink : MonoBehaviour
    {
        private void OnTriggerEnter(Collider other)
        {
            var manager = SimulationManager.Current;
            var mine = GetComponent<Node>();
            var their = other.GetComponent<Node>();
            if (manager == null || mine == null || their == null || manager.HasLink(mine.Id, their.Id)) return;
            manager.AddLink(mine.Id, their.Id, directed: true);
        }
    }

    internal sealed class UsersScene : SceneBuilder
    {
        private static readonly string[] Names = { "nodes" };

        public int nodes = 10;

        public override IReadOnlyList<string> MetricNames => Names;

        public override void Measure(double[] values) => values[0] = SimulationManager.Current.Nodes.Count;

        protected override void Build(SimulationManager manager)
        {
            manager.Ticked += ticked =>
                Debug.Log(ticked.Tick + " at " + ticked.SimulatedTime + " s, " + ticked.LinkCount + " links, " + ticked.ErrorCount + " errors");
            for (var i = 0; i < nodes; i++)
            {
                var node = new GameObject("Node " + i).AddComponent<Node>();
                node.Program = "hops";
                node.Parameters.Add(new NodeParameter("speed", "2"));
                node.gameObject.AddComponent<RadiusNeighbourhood>().Radius = manager.Random.Range(1f, 3f);
                node.gameObject.AddComponent<UsersSensor>();
                node.gameObject.AddComponent<UsersActuator>();
            }
        }
    }
}
