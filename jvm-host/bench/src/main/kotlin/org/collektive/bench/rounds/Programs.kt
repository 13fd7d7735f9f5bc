package org.collektive.bench.rounds

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.stdlib.accumulation.convergeCast
import it.unibo.collektive.stdlib.consensus.boundedElection
import it.unibo.collektive.stdlib.spreading.bellmanFordGradientCast
import it.unibo.collektive.stdlib.spreading.distanceTo
import it.unibo.collektive.stdlib.spreading.gradientCast
import it.unibo.collektive.stdlib.util.euclideanDistance2D
import kotlin.math.sqrt

/** Program a, the case study: heads for neighbours that sense a higher intensity, and away from obstacles. */
internal fun Aggregate<Int>.gradientAscent(sensors: SensorData): Heading {
    val here = sensors.position
    var x = 0.0
    var y = 0.0
    for ((_, there) in neighboring(sensors).neighbors.list) {
        val more = there.intensity - sensors.intensity
        if (more <= 0.0) continue
        val dx = there.position.x - here.x
        val dy = there.position.y - here.y
        val pull = more / sqrt(dx * dx + dy * dy)
        x += pull * dx
        y += pull * dy
    }
    for (obstacle in sensors.obstacles) {
        val distance = sqrt(obstacle.x * obstacle.x + obstacle.y * obstacle.y)
        val push = 1 / (distance * distance * distance)
        x -= push * obstacle.x
        y -= push * obstacle.y
    }
    return Heading(x, y)
}

/** Program b: the distance from the source, by the self-stabilising `distanceTo`. */
internal fun Aggregate<Int>.distanceFromSource(sensors: SensorData): Double =
    distanceTo(sensors.isSource, euclideanDistance2D(sensors.position))

/** Program b2: the distance from the source, by `bellmanFordGradientCast`. */
internal fun Aggregate<Int>.bellmanFordFromSource(sensors: SensorData): Double = bellmanFordGradientCast(
    source = sensors.isSource,
    local = if (sensors.isSource) 0.0 else Double.POSITIVE_INFINITY,
    accumulateData = { fromSource, toNeighbor, _ -> fromSource + toNeighbor },
    metric = euclideanDistance2D(sensors.position),
)

/** Program c: elects leaders within 5 metres, counts the followers of each, and broadcasts the count to them. */
internal fun Aggregate<Int>.followers(sensors: SensorData): Region {
    val metric = euclideanDistance2D(sensors.position)
    val isLeader = boundedElection(bound = 5.0, metric = metric) == localId
    val potential = distanceTo(isLeader, metric)
    val count = convergeCast(1, potential) { a, b -> a + b }
    return Region(isLeader, gradientCast(isLeader, count, metric))
}
