using System.Collections.Generic;
using Collektive.Unity;
using UnityEngine;

namespace Lamps
{
    public sealed class BrightnessSensor : Sensor<lamps.SensorData>
    {
        public float Brightness;

        protected override void Sense(ref lamps.SensorData data)
        {
            data.Brightness = Brightness;
            data.Labels.Add(name);
            data.Place = transform.position;
        }
    }

    public sealed class LampActuator : Actuator<lamps.ActuatorData>
    {
        public float Brightest;
        public int Seen;

        protected override void Act(lamps.ActuatorData data)
        {
            Brightest = data.Brightest;
            Seen = data.SeenLength;
        }
    }

    public sealed class LampScene : SceneBuilder
    {
        public int lamps = 10;
        public bool loop;

        private static readonly string[] Names = { "agreeing", "seen" };
        private readonly List<Node> nodes = new List<Node>();

        public override IReadOnlyList<string> MetricNames => Names;

        public override void Measure(double[] values)
        {
            values[0] = 0;
            values[1] = 0;
            foreach (var node in nodes)
            {
                if (!node.TryGetAnswer(out global::lamps.ActuatorData answer)) continue;
                if (answer.Brightest == lamps) values[0]++;
                values[1] += answer.SeenLength;
            }
        }

        protected override void Build(SimulationManager manager)
        {
            for (var i = 0; i < lamps; i++)
            {
                var lamp = new GameObject("Lamp " + i);
                lamp.transform.position = new Vector3(i, 0, 0);
                nodes.Add(lamp.AddComponent<Node>());
                lamp.AddComponent<BrightnessSensor>().Brightness = i + 1;
                lamp.AddComponent<LampActuator>();
                if (i > 0) manager.AddLink(nodes[i - 1].Id, nodes[i].Id);
            }
            if (loop) manager.AddLink(nodes[lamps - 1].Id, nodes[0].Id);
        }
    }
}
