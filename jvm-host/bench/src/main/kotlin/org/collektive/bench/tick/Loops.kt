package org.collektive.bench.tick

import kotlin.math.sqrt

/** The case study's round as plain loops over arrays: the lower bound. */
internal class Loops(private val grid: Grid) : Workload {
    private val size = grid.size
    private val x = FloatArray(size, grid::x)
    private val z = FloatArray(size, grid::z)
    private val targetX = FloatArray(size)
    private val targetZ = FloatArray(size)
    private var intensity = FloatArray(size)
    private var received = FloatArray(size)
    private val first = IntArray(size + 1)
    private val neighbors: IntArray
    private var tick = 0L

    init {
        val all = ArrayList<Int>()
        for (node in 0 until size) {
            grid.forEachNeighbor(node) { all.add(it) }
            first[node + 1] = all.size
        }
        neighbors = all.toIntArray()
    }

    override fun tick() {
        tick++
        // Nodes receive what their neighbours sent in the previous tick, so the two arrays are swapped.
        val spare = received
        received = intensity
        intensity = spare
        for (node in 0 until size) intensity[node] = grid.intensity(node, tick)
        for (node in 0 until size) round(node)
    }

    private fun round(node: Int) {
        var towardsX = 0.0
        var towardsZ = 0.0
        for (index in first[node] until first[node + 1]) {
            val other = neighbors[index]
            val dx = (x[other] - x[node]).toDouble()
            val dz = (z[other] - z[node]).toDouble()
            val distance = sqrt(dx * dx + dz * dz)
            val pull = (received[other] - intensity[node]) / distance
            towardsX += pull * dx
            towardsZ += pull * dz
        }
        if (node % Grid.OBSTACLE_EVERY == 0) {
            val dx = Grid.OBSTACLE_X.toDouble()
            val dz = Grid.OBSTACLE_Z.toDouble()
            val distance = sqrt(dx * dx + dz * dz)
            val push = OBSTACLE_WEIGHT / (distance * distance * distance)
            towardsX -= push * dx
            towardsZ -= push * dz
        }
        val length = sqrt(towardsX * towardsX + towardsZ * towardsZ)
        val scale = if (length < TOO_SMALL) 0.0 else 1 / length
        targetX[node] = (x[node] + scale * towardsX).toFloat()
        targetZ[node] = (z[node] + scale * towardsZ).toFloat()
    }

    override fun close() = Unit

    private companion object {
        const val OBSTACLE_WEIGHT = 2.0
        const val TOO_SMALL = 1e-6
    }
}
