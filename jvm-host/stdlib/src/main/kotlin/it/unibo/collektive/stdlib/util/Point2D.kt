package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable
import kotlin.math.sqrt

/** A point in the plane. */
@Serializable
public data class Point2D(public val x: Double, public val y: Double) {
    /** The Euclidean distance to [other]. */
    public fun distanceTo(other: Point2D): Double {
        val dx = x - other.x
        val dy = y - other.y
        return sqrt(dx * dx + dy * dy)
    }
}
