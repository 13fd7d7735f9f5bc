package org.collektive.bench.rounds

import kotlin.math.ceil
import kotlin.math.sqrt
import kotlin.random.Random

/** Devices in the plane with symmetric links. Ids are 0 until [size]; neighbours are in ascending order. */
public class Topology internal constructor(
    internal val x: DoubleArray,
    internal val y: DoubleArray,
    internal val neighbors: Array<IntArray>,
) {
    internal val size: Int get() = x.size

    internal fun distance(a: Int, b: Int): Double {
        val dx = x[a] - x[b]
        val dy = y[a] - y[b]
        return sqrt(dx * dx + dy * dy)
    }

    public companion object {
        private const val SEED = 42

        /** Creates the topology `grid8` or `rgg10`. */
        public fun named(name: String, size: Int): Topology = when (name) {
            "grid8" -> grid(size)
            "rgg10" -> randomGeometric(size, meanDegree = 10.0)
            else -> throw IllegalArgumentException("unknown topology '$name'; use grid8 or rgg10")
        }

        /** A square grid with spacing 1, ids row by row; each device is linked to the 8 around it. */
        private fun grid(size: Int): Topology {
            val width = ceil(sqrt(size.toDouble())).toInt()
            return linked(DoubleArray(size) { (it % width).toDouble() }, DoubleArray(size) { (it / width).toDouble() }, reach = 1.5)
        }

        /** Random points in a square, with ids independent of positions, linked within the radius that gives [meanDegree]. */
        private fun randomGeometric(size: Int, meanDegree: Double): Topology {
            val random = Random(SEED)
            val side = sqrt(size.toDouble())
            val points = List(size) { random.nextDouble() * side to random.nextDouble() * side }
            val reach = sqrt(meanDegree / Math.PI)
            return linked(DoubleArray(size) { points[it].first }, DoubleArray(size) { points[it].second }, reach)
        }

        private fun linked(x: DoubleArray, y: DoubleArray, reach: Double): Topology {
            val cells = HashMap<Pair<Int, Int>, MutableList<Int>>()
            fun cell(id: Int) = (x[id] / reach).toInt() to (y[id] / reach).toInt()
            for (id in x.indices) cells.getOrPut(cell(id), ::ArrayList) += id
            val neighbors = Array(x.size) { id ->
                val (column, row) = cell(id)
                (column - 1..column + 1).flatMap { c -> (row - 1..row + 1).flatMap { r -> cells[c to r].orEmpty() } }
                    .filter { it != id && (x[it] - x[id]) * (x[it] - x[id]) + (y[it] - y[id]) * (y[it] - y[id]) <= reach * reach }
                    .sorted().toIntArray()
            }
            return Topology(x, y, neighbors)
        }
    }
}
