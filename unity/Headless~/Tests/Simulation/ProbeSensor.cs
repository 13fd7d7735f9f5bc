using Collektive.Unity;
using probe;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Gives the program a number and the place of the node.</summary>
    public sealed class ProbeSensor : Sensor<SensorData>
    {
        public float Value;

        protected override void Sense(ref SensorData data)
        {
            data.Value = Value;
            data.Position = transform.position.ToValue();
        }
    }
}
