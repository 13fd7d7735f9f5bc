package gradients

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.spreading.bellmanFordGradientCast
import it.unibo.collektive.stdlib.spreading.gradientCast
import it.unibo.collektive.stdlib.spreading.multiGradientCast
import it.unibo.collektive.stdlib.util.euclideanDistance2D
import org.collektive.api.Metric
import org.collektive.api.NetworkSnapshot
import org.collektive.api.Program
import standard.ActuatorData
import standard.SensorData
import java.util.ArrayDeque
import kotlin.math.abs

/** The distance in metres that stands for an unknown distance. Greater distances count as unknown, too. */
private const val FAR = 100.0

/** The ids of the nodes that may be sources. */
private val CANDIDATES = listOf(0, 48)

/** Whether the node is the source. Each candidate is in a set that is active only before or only after the switch. */
private val SensorData.isSource get() = sets() != 0L

private fun Aggregate<Int>.metric(sensors: SensorData) =
    euclideanDistance2D(sensors.position().x().toDouble() to sensors.position().z().toDouble())

private fun SensorData.start() = if (isSource) 0.0 else Double.POSITIVE_INFINITY

private fun answer(distance: Double) = ActuatorData(value = minOf(distance, FAR), flag = distance < FAR)

/** Computes distances along self-avoiding paths, which the messages contain. */
@Program("path-vector")
public fun Aggregate<Int>.pathVector(sensors: SensorData): ActuatorData = answer(
    gradientCast(sensors.isSource, sensors.start(), metric(sensors), accumulateData = { _, toNeighbor, data -> data + toNeighbor }),
)

/** Computes a permanent gradient from each candidate, and returns the distance to the nearest candidate that is a source. */
@Program("multi-path")
public fun Aggregate<Int>.multiPath(sensors: SensorData): ActuatorData {
    val distances = multiGradientCast(
        CANDIDATES,
        sensors.start(),
        metric(sensors),
        accumulateData = { _, toNeighbor, data -> data + toNeighbor },
    )
    return answer(distances.values.min())
}

/** Sends only distances. Messages are small, but distances creep up when a source disappears. */
@Program("bellman-ford")
public fun Aggregate<Int>.bellmanFord(sensors: SensorData): ActuatorData = answer(
    bellmanFordGradientCast(sensors.isSource, sensors.start(), { _, toNeighbor, data -> data + toNeighbor }, metric = metric(sensors)),
)

/** Returns the mean difference in metres between the nodes' distances and the lengths of the shortest paths along links. */
@Metric("error")
public fun error(network: NetworkSnapshot<SensorData, ActuatorData>): Double {
    val shortest = shortestPaths(network)
    return network.nodes.map { abs((it.answer?.value ?: FAR) - shortest.getValue(it.id)) }.average()
}

/** Computes the shortest paths with the algorithm of Bellman and Ford, with a queue of the nodes whose distance has become shorter. */
private fun shortestPaths(network: NetworkSnapshot<SensorData, ActuatorData>): Map<Int, Double> {
    val distances = network.nodes.associateTo(LinkedHashMap()) { it.id to if (it.sensors?.isSource == true) 0.0 else FAR }
    val pending = ArrayDeque(network.nodes)
    while (true) {
        val node = pending.poll() ?: return distances
        // The incoming links are sufficient, because links have the same length in both directions.
        for (link in node.links) {
            val path = distances.getValue(node.id) + link.length
            if (path >= distances.getValue(link.from)) continue
            distances[link.from] = path
            network[link.from]?.let(pending::add)
        }
    }
}
