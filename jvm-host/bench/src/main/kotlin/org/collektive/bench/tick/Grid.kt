package org.collektive.bench.tick

import kotlin.math.ceil
import kotlin.math.sqrt

/**
 * The benchmark's world: nodes on a grid with 1 m spacing, as square as possible, each linked to its (up to) eight neighbours. The C# side
 * builds the same one.
 */
internal class Grid(val size: Int) {
    private val width = ceil(sqrt(size.toDouble())).toInt()

    fun x(node: Int): Float = (node % width).toFloat()

    fun z(node: Int): Float = (node / width).toFloat()

    /** The intensity that [node] senses in [tick]. */
    fun intensity(node: Int, tick: Long): Float = (node * 37 + tick % 64).toFloat() % 101

    /** Calls [link] for each directed link. */
    inline fun forEachLink(link: (from: Int, to: Int, length: Float) -> Unit) {
        for (to in 0 until size) {
            forEachNeighbor(to) { from ->
                val dx = x(from) - x(to)
                val dz = z(from) - z(to)
                link(from, to, sqrt(dx * dx + dz * dz))
            }
        }
    }

    /** Calls [visit] for the neighbours of [node], in ascending order. */
    inline fun forEachNeighbor(node: Int, visit: (Int) -> Unit) {
        for (dz in -1..1) {
            for (dx in -1..1) {
                val column = node % width + dx
                val other = (node / width + dz) * width + column
                if (other != node && column in 0 until width && other in 0 until size) visit(other)
            }
        }
    }

    companion object {
        /** Every fourth node senses one obstacle, at this offset from it in metres. */
        const val OBSTACLE_EVERY = 4
        const val OBSTACLE_X = 0.4f
        const val OBSTACLE_Z = 0.3f
    }
}
