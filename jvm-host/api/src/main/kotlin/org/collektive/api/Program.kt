package org.collektive.api

/**
 * Makes a public top-level function a program that nodes can run:
 *
 * ```
 * @Program("follow-the-leader", parameters = [Parameter("gap", "1.0", "Metres to the next node.")])
 * public fun Aggregate<Int>.followTheLeader(sensors: SensorData, device: Device): ActuatorDataT = ...
 * ```
 * `device` may be left out. `SensorData` and `ActuatorDataT` are the types generated from the project's schema.
 *
 * @property name unique among the session's jars; what scenes and scenarios say.
 * @property parameters what each node may set.
 */
@Target(AnnotationTarget.FUNCTION)
@Retention(AnnotationRetention.RUNTIME)
@MustBeDocumented
public annotation class Program(val name: String, val parameters: Array<Parameter> = [])

/**
 * A setting of a program that each node may have its own value for.
 *
 * @property name unique in its program.
 * @property default value of nodes that set none, as text.
 * @property description one line for the inspector: meaning, unit, range.
 */
@Target()
@Retention(AnnotationRetention.RUNTIME)
public annotation class Parameter(val name: String, val default: String, val description: String = "")
