package org.collektive.bench.rounds

import it.unibo.collektive.stdlib.util.Point2D

/** What a device of the benchmarks senses; obstacles are relative to it. */
internal class Senses(val position: Point2D, val intensity: Double, val obstacles: List<Point2D>, val isSource: Boolean)

/** What it answers in program a: where to go. */
internal data class Heading(val x: Double, val y: Double)

/** What it answers in program c: whether it leads, and how many devices its leader counted. */
internal data class Region(val isLeader: Boolean, val devices: Int)

/** Every fourth device has an obstacle beside it; the source is in a corner, and intensity falls with the distance from it. */
internal fun senses(topology: Topology): List<Senses> {
    val source = (0 until topology.size).minBy { topology.x[it] + topology.y[it] }
    return List(topology.size) {
        val intensity = 1 / (1 + topology.distance(it, source))
        val obstacles = if (it % 4 == 0) listOf(Point2D(OBSTACLE_X, OBSTACLE_Y)) else emptyList()
        Senses(Point2D(topology.x[it], topology.y[it]), intensity, obstacles, it == source)
    }
}

internal const val OBSTACLE_X = 0.3
internal const val OBSTACLE_Y = 0.4
