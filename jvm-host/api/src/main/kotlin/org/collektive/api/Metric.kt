package org.collektive.api

/**
 * Declares a public top-level function as a metric, for values that SQL cannot express:
 *
 * ```
 * @Metric("farthest")
 * public fun farthest(network: NetworkSnapshot<SensorData, ActuatorData>): Double =
 *     network.nodes.maxOf { it.answer?.distance?.toDouble() ?: Double.NaN }
 * ```
 * Scenarios select it with `"metrics": { "farthest": { "function": "farthest" } }`. `SensorData` and `ActuatorData` are generated from the
 * project's schema.
 *
 * @property name the name in scenarios; unique among the session's jars.
 */
@Target(AnnotationTarget.FUNCTION)
@Retention(AnnotationRetention.RUNTIME)
@MustBeDocumented
public annotation class Metric(val name: String)

/**
 * All nodes after the rounds of a tick.
 *
 * @param S the sensor data of the project's schema.
 * @param A the actuator data of the project's schema.
 * @property time simulated time of the tick, in seconds.
 * @property nodes the nodes by ascending id.
 */
public class NetworkSnapshot<S : Any, A : Any>(public val time: Double, public val nodes: List<NodeSnapshot<S, A>>) {
    /** Returns the node [id], or `null` if it does not exist. */
    public operator fun get(id: Int): NodeSnapshot<S, A>? = nodes.binarySearchBy(id) { it.id }.let { if (it < 0) null else nodes[it] }
}

/**
 * A node after the rounds of a tick.
 *
 * @property id the node's id, 0 or greater.
 * @property sensors the sensor data of this tick, valid until the metric returns; `null` if the node did not run a round in this tick.
 * @property answer the last answer; `null` before the first.
 * @property links the links on which the node receives messages, by ascending id of their senders.
 */
public class NodeSnapshot<S : Any, A : Any>(
    public val id: Int,
    public val sensors: S?,
    public val answer: A?,
    public val links: List<LinkSnapshot>,
)

/**
 * A link on which a node receives messages.
 *
 * @property from id of the sender.
 * @property length the length in metres, as accurate as the Length Tolerance of the neighbourhood rule.
 * @property attenuation the attenuation, 0 (clear) or greater.
 */
public class LinkSnapshot(public val from: Int, public val length: Double, public val attenuation: Double)
