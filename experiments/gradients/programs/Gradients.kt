package gradients

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.spreading.bellmanFordGradientCast
import it.unibo.collektive.stdlib.spreading.gradientCast
import it.unibo.collektive.stdlib.spreading.multiGradientCast
import it.unibo.collektive.stdlib.util.euclideanDistance2D
import org.collektive.api.Program

private const val FAR = Double.POSITIVE_INFINITY

/** Ids of the nodes that may be sources: the scene makes these first. */
private val CANDIDATES = listOf(0, 1)

private fun Aggregate<Int>.metric(sensors: SensorData) =
    euclideanDistance2D(sensors.position().x().toDouble() to sensors.position().z().toDouble())

private fun SensorData.start() = if (source()) 0.0 else FAR

private fun answer(distance: Double) = ActuatorData(distance = if (distance < FAR) distance.toFloat() else -1f)

/** Distances along self-avoiding paths, which offers carry with them. */
@Program("path-vector")
public fun Aggregate<Int>.pathVector(sensors: SensorData): ActuatorData = answer(
    gradientCast(sensors.source(), sensors.start(), metric(sensors), accumulateData = { _, toNeighbor, data -> data + toNeighbor }),
)

/** A gradient from each candidate, all the time; the nearest candidate that is a source counts. */
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

/** Distances alone: small messages, but distances creep up when a source vanishes. */
@Program("bellman-ford")
public fun Aggregate<Int>.bellmanFord(sensors: SensorData): ActuatorData = answer(
    bellmanFordGradientCast(sensors.source(), sensors.start(), { _, toNeighbor, data -> data + toNeighbor }, metric = metric(sensors)),
)
