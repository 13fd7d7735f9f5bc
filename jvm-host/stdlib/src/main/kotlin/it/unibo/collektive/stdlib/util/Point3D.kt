package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable
import kotlin.math.sqrt

/** A point in space. */
@Serializable
public data class Point3D(public val x: Double, public val y: Double, public val z: Double) {
    /** The Euclidean distance to [other]. */
    public fun distanceTo(other: Point3D): Double {
        val dx = x - other.x
        val dy = y - other.y
        val dz = z - other.z
        return sqrt(dx * dx + dy * dy + dz * dz)
    }
}
