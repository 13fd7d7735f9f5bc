using System.Collections.Generic;

namespace Collektive.Bridge
{
    /// <summary>
    /// One user schema as the bridge sees it: how to stage sensor data and read actuator data whose fields only generated code
    /// knows. Implemented by <c>./collektive generate</c>; instances are stateless.
    /// </summary>
    public abstract class DataSchema
    {
        /// <summary>Name of the schema, equal to that of the JVM side.</summary>
        public abstract string Name { get; }

        /// <summary>Name of the schema's file without <c>.fbs</c>, after which the jar of its programs is named.</summary>
        public abstract string File { get; }

        /// <summary>Version of the package whose generator made the class; empty for code of versions that did not say.</summary>
        public virtual string GeneratorVersion => "";

        /// <summary>
        /// Fingerprints of <c>SensorData</c>, <c>ActuatorData</c> and, where defined, <c>GlobalData</c>, nested types included.
        /// </summary>
        public abstract IReadOnlyList<KeyValuePair<string, ulong>> Types { get; }

        /// <summary>Makes the staging area of one session's sensor data.</summary>
        public abstract SensorBuffer CreateSensors();

        /// <summary>Makes the reader of one session's actuator data.</summary>
        public abstract ActuatorBuffer CreateActuators();

        /// <summary>Makes the staging area of one session's global data; null when the schema has no <c>GlobalData</c>.</summary>
        public virtual GlobalBuffer CreateGlobals() => null;
    }
}
