using Collektive.Unity;
using probe;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Keeps what the program answered.</summary>
    public sealed class ProbeActuator : Actuator<ActuatorDataValue>
    {
        public ActuatorDataValue Last;
        public int Calls;

        protected override void Act(ActuatorDataValue data)
        {
            Last = data;
            Calls++;
        }
    }
}
