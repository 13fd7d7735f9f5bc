using System.Collections.Generic;
using Collektive.Unity;
using UnityEngine;

namespace template
{
    /// <summary>Moving nodes on a square. The first one is the source.</summary>
    public sealed class TemplateScene : SceneBuilder
    {
        private static readonly string[] Names = { "reached", "farthest" };

        /// <summary>Number of nodes.</summary>
        [Min(1)]
        public int nodes = 100;

        /// <summary>Side of the square in metres.</summary>
        public float side = 30;

        /// <summary>Range of messages in metres.</summary>
        public float range = 5;

        /// <summary>Speed in metres per second.</summary>
        public float speed = 1;

        private readonly List<Wanderer> wanderers = new List<Wanderer>();
        private SimulationManager manager;

        /// <summary>Each name is a column of metrics.csv.</summary>
        public override IReadOnlyList<string> MetricNames => Names;

        /// <summary>The meaning of the nodes' colours in the replay.</summary>
        public override string ColouringName => "distance";

        /// <summary>The share of nodes that know a path to the source, and the greatest distance in metres.</summary>
        public override void Measure(double[] values)
        {
            var reached = 0;
            values[1] = 0;
            foreach (var node in manager.Nodes)
            {
                var distance = GetColouringValue(node);
                if (distance >= 0) reached++;
                values[1] = System.Math.Max(values[1], distance);
            }
            values[0] = reached / (double)manager.Nodes.Count;
        }

        /// <inheritdoc/>
        public override float GetColouringValue(Node node) => node.TryGetAnswer(out ActuatorData answer) ? answer.Distance : -1;

        /// <inheritdoc/>
        protected override void Build(SimulationManager manager)
        {
            this.manager = manager;
            for (var i = 0; i < nodes; i++)
            {
                var place = new Vector3(manager.Random.Range(0f, side), 0.25f, manager.Random.Range(0f, side));
                AddNode(place).GetComponent<SourceSensor>().isSource = i == 0;
            }
            // Once per tick: Update and FixedUpdate depend on the frame rate in Unity.
            manager.Ticked += Move;
        }

        private void OnDestroy()
        {
            if (manager != null) manager.Ticked -= Move;
        }

        private void Move(SimulationManager manager)
        {
            foreach (var wanderer in wanderers)
            {
                // Destroyed nodes are equal to null.
                if (wanderer != null) wanderer.Move(manager.Settings.deltaTime);
            }
        }

        private GameObject AddNode(Vector3 place)
        {
            var body = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            body.transform.position = place;
            body.transform.localScale = 0.5f * Vector3.one;
            body.AddComponent<Node>();
            body.AddComponent<RadiusNeighbourhood>().Radius = range;
            body.AddComponent<SourceSensor>();
            body.AddComponent<DistanceHue>();
            var wanderer = body.AddComponent<Wanderer>();
            wanderer.Begin(side, speed, manager.Random.Range(0f, 2 * Mathf.PI));
            wanderers.Add(wanderer);
            return body;
        }
    }
}
