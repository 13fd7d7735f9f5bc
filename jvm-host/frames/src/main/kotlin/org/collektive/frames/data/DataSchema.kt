package org.collektive.frames.data

/**
 * A user's schema: reads its sensor data and writes its actuator data.
 *
 * Generated code implements it; [java.util.ServiceLoader] finds it in the jar of the programs. Stateless, so safe on any thread.
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

    /** Makes a reader of the table `Sensors`, for one thread at a time. */
    public fun sensorReader(): ElementReader

    /** Makes a view of sensor data, of class [sensorType], for one thread at a time. */
    public fun sensorView(): View

    /** Makes a reader of the table `Actuators`, for one thread at a time. */
    public fun actuatorReader(): ElementReader

    /** Makes a writer of the table `Actuators`. */
    public fun actuatorWriter(): ActuatorWriter

    /** Makes a reader of the table `GlobalData`; `null` when the schema defines none. */
    public fun globalReader(): GlobalReader?
}
