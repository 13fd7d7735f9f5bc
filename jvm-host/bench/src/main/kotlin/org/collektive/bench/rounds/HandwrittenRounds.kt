package org.collektive.bench.rounds

import kotlin.math.sqrt

/** Programs a and b2 as hand-written loops over arrays, without devices: the links of all devices are in one array. */
public class HandwrittenRounds(program: String, private val topology: Topology) {
    private val size = topology.size
    private val firstLink = IntArray(size + 1).also { for (id in 0 until size) it[id + 1] = it[id] + topology.neighbors[id].size }
    private val links = IntArray(firstLink[size]).also { topology.neighbors.forEachIndexed { id, ids -> ids.copyInto(it, firstLink[id]) } }
    private val x = topology.x
    private val y = topology.y
    private val sensorData = sensorData(topology)
    private val intensity = DoubleArray(size) { sensorData[it].intensity }
    private val isSource = BooleanArray(size) { sensorData[it].isSource }
    private val hasObstacle = BooleanArray(size) { sensorData[it].obstacles.isNotEmpty() }
    private val step = when (program) {
        "a" -> ::gradientAscent
        "b2" -> ::bellmanFord
        else -> throw IllegalArgumentException("program '$program' has no hand-written loops; use a or b2")
    }

    internal val headingX = DoubleArray(size)
    internal val headingY = DoubleArray(size)

    /** The distances of b2 after the last tick; `former` contains those of the previous tick. */
    internal var distances = DoubleArray(size) { Double.POSITIVE_INFINITY }
    private var former = DoubleArray(size)

    /** Runs one round of every device. */
    public fun tick(): Unit = step()

    private fun gradientAscent() {
        for (id in 0 until size) {
            var sumX = 0.0
            var sumY = 0.0
            for (link in firstLink[id] until firstLink[id + 1]) {
                val other = links[link]
                val more = intensity[other] - intensity[id]
                if (more <= 0.0) continue
                val dx = x[other] - x[id]
                val dy = y[other] - y[id]
                val pull = more / sqrt(dx * dx + dy * dy)
                sumX += pull * dx
                sumY += pull * dy
            }
            if (hasObstacle[id]) {
                val distance = sqrt(OBSTACLE_X * OBSTACLE_X + OBSTACLE_Y * OBSTACLE_Y)
                val push = 1 / (distance * distance * distance)
                sumX -= push * OBSTACLE_X
                sumY -= push * OBSTACLE_Y
            }
            headingX[id] = sumX
            headingY[id] = sumY
        }
    }

    private fun bellmanFord() {
        former = distances.also { distances = former }
        for (id in 0 until size) {
            var least = Double.POSITIVE_INFINITY
            for (link in firstLink[id] until firstLink[id + 1]) {
                val other = links[link]
                val dx = x[other] - x[id]
                val dy = y[other] - y[id]
                val distance = former[other] + sqrt(dx * dx + dy * dy)
                if (distance < least) least = distance
            }
            distances[id] = if (isSource[id]) 0.0 else least
        }
    }
}
