package org.collektive.frames.data

/**
 * A user's schema, which creates readers of its sensor data and writers of its actuator data.
 *
 * Generated code implements it, and [java.util.ServiceLoader] finds it in the programs' jar. Thread-safe, because it is stateless.
 */
public interface DataSchema {
    /** Name of the schema, the same on the C# side. */
    public val name: String

    /** Fingerprints of `SensorData`, `ActuatorData` and, if defined, `GlobalData`; they cover nested types. */
    public val types: Map<String, Long>

    /** The class of the parameter of programs (`SensorData`). */
    public val sensorType: Class<*>

    /** The class of the result of programs (`ActuatorData`). */
    public val actuatorType: Class<*>

    /** Creates a reader of the table `Sensors`, for one thread at a time. */
    public fun sensorReader(): ElementReader

    /** Creates a view of sensor data, of class [sensorType], for one thread at a time. */
    public fun sensorView(): View

    /** Creates a reader of the table `Actuators`, for one thread at a time. */
    public fun actuatorReader(): ElementReader

    /** Creates a writer of the table `Actuators`. */
    public fun actuatorWriter(): ActuatorWriter

    /** Creates a reader of the table `GlobalData`, or returns `null` if the schema does not define it. */
    public fun globalReader(): GlobalReader?
}
