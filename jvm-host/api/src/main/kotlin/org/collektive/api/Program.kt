package org.collektive.api

import kotlin.reflect.KClass

/**
 * Declares a public top-level function as a program that nodes can run:
 *
 * ```
 * @Program("follow-the-leader", parameters = [Parameter("gap", "1.0", "Metres to the next node.")])
 * public fun Aggregate<Int>.followTheLeader(sensors: SensorData, device: Device): ActuatorData = ...
 * ```
 * The parameter `device` is optional. `SensorData` and `ActuatorData` are generated from the project's schema.
 *
 * @property name the name in scenes and scenarios; unique among the session's jars.
 * @property parameters the settings that each node may override.
 */
@Target(AnnotationTarget.FUNCTION)
@Retention(AnnotationRetention.RUNTIME)
@MustBeDocumented
public annotation class Program(val name: String, val parameters: Array<Parameter> = [])

/**
 * A setting of a program; each node may override its value.
 *
 * @property name unique in its program.
 * @property default the value of nodes that do not override it, as text.
 * @property description one line for the inspector with meaning, unit and range.
 * @property values an enum class whose constants are the possible values; [default] must be the name of a constant. Without it, any text
 * is possible.
 */
@Target()
@Retention(AnnotationRetention.RUNTIME)
public annotation class Parameter(
    val name: String,
    val default: String,
    val description: String = "",
    val values: KClass<out Enum<*>> = Enum::class,
)
