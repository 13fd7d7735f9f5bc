using Collektive.Unity;
using probe;

namespace Collektive.Headless.Tests.Simulation
{
    /// <summary>Stores the program's last answer.</summary>
    public sealed class ProbeActuator : Actuator<ActuatorData>
    {
        public ActuatorData Last;
        public int Calls;

        protected override void Act(ActuatorData data)
        {
            Last = data;
            Calls++;
        }
    }
}
