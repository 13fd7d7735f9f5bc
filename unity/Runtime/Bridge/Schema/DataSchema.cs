using System.Collections.Generic;
using System.ComponentModel;

namespace Collektive.Bridge
{
    /// <summary>
    /// A user's schema. It creates buffers for sensor and actuator data, whose fields only generated code knows. <c>./collektive generate</c> writes the
    /// implementations, which are stateless.
    /// </summary>
    [EditorBrowsable(EditorBrowsableState.Never)]
    public abstract class DataSchema
    {
        /// <summary>Name of the schema, which is the same on the JVM.</summary>
        public abstract string Name { get; }

        /// <summary>Name of the schema's file without <c>.fbs</c>. The jar of its programs has the same name.</summary>
        public abstract string File { get; }

        /// <summary>Version of the package that generated the class; empty for code from versions that did not record it.</summary>
        public virtual string GeneratorVersion => "";

        /// <summary>
        /// Fingerprints of <c>SensorData</c>, <c>ActuatorData</c> and, where defined, <c>GlobalData</c>, nested types included.
        /// </summary>
        public abstract IReadOnlyList<KeyValuePair<string, ulong>> Types { get; }

        /// <summary>Creates the buffer for a session's sensor data.</summary>
        public abstract SensorBuffer CreateSensors();

        /// <summary>Creates the reader of a session's actuator data.</summary>
        public abstract ActuatorBuffer CreateActuators();

        /// <summary>Creates the buffer for a session's global data, or returns null if the schema has no <c>GlobalData</c>.</summary>
        public virtual GlobalBuffer CreateGlobals() => null;
    }
}
