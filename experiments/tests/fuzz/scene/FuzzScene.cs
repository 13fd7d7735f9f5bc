using System;
using System.Collections.Generic;
using Collektive.Unity;
using UnityEngine;

namespace Fuzz
{
    public sealed class LevelSensor : Sensor<fuzz.SensorData>
    {
        public float Level;

        protected override void Sense(ref fuzz.SensorData data) => data.Level = Level;
    }

    /// <summary>A scene with metrics of arbitrary names. The fuzzer's model computes their values, too.</summary>
    public sealed class FuzzScene : SceneBuilder
    {
        public string names = "one";
        public int nodes = 2;
        public double slope = 1;
        public string odd = "";
        public string label = "";
        public bool flag;
        public Vector3 place;
        public int fate;

        private SimulationManager simulation;

        public override IReadOnlyList<string> MetricNames => names.Split('|');

        public override void Measure(double[] values)
        {
            for (var i = 0; i < values.Length; i++) values[i] = slope * (i + 1) + simulation.SimulatedTime + label.Length + (flag ? 100 : 0) + place.x;
            if (odd == "nan") values[0] = double.NaN;
            if (odd == "inf") values[values.Length - 1] = double.NegativeInfinity;
        }

        protected override void Build(SimulationManager manager)
        {
            simulation = manager;
            if (fate == 1) throw new InvalidOperationException("as requested");
            if (fate == 2) Application.Quit(3);
            for (var i = 0; i < nodes; i++)
            {
                var holder = new GameObject("Node " + i);
                holder.AddComponent<Node>();
                holder.AddComponent<LevelSensor>().Level = (float)slope;
            }
        }
    }
}
