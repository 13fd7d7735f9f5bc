using Collektive.Unity;
using probe;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Senses a number and the position of the node.</summary>
    public sealed class ProbeSensor : Sensor<SensorData>
    {
        public float Value;

        protected override void Sense(ref SensorData data)
        {
            data.Value = Value;
            data.Position = transform.position;
        }
    }
}
