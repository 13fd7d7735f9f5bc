package org.collektive.bench.rounds

import it.unibo.collektive.stdlib.util.Point2D

/** The sensor data of a device; the positions of obstacles are relative to it. */
internal class SensorData(val position: Point2D, val intensity: Double, val obstacles: List<Point2D>, val isSource: Boolean)

/** The result of program a: the direction of movement. */
internal data class Heading(val x: Double, val y: Double)

/** The result of program c: whether the device leads, and how many devices its leader counted. */
internal data class Region(val isLeader: Boolean, val devices: Int)

/** Sensor data of all devices: every fourth has an obstacle next to it; the source is in a corner, and intensity falls with distance. */
internal fun sensorData(topology: Topology): List<SensorData> {
    val source = (0 until topology.size).minBy { topology.x[it] + topology.y[it] }
    return List(topology.size) {
        val intensity = 1 / (1 + topology.distance(it, source))
        val obstacles = if (it % 4 == 0) listOf(Point2D(OBSTACLE_X to OBSTACLE_Y)) else emptyList()
        SensorData(Point2D(topology.x[it] to topology.y[it]), intensity, obstacles, it == source)
    }
}

internal const val OBSTACLE_X = 0.3
internal const val OBSTACLE_Y = 0.4
