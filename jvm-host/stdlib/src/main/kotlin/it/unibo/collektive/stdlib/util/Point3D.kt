package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable
import kotlin.math.sqrt

/** A point in space, or a vector. */
@Serializable
@JvmInline
public value class Point3D(internal val coordinates: Triple<Double, Double, Double>) {
    /** The x coordinate. */
    public val x: Double get() = coordinates.first

    /** The y coordinate. */
    public val y: Double get() = coordinates.second

    /** The z coordinate. */
    public val z: Double get() = coordinates.third

    /** Returns the x coordinate. */
    public operator fun component1(): Double = x

    /** Returns the y coordinate. */
    public operator fun component2(): Double = y

    /** Returns the z coordinate. */
    public operator fun component3(): Double = z

    /** Returns the sum of this vector and [other]. */
    public operator fun plus(other: Point3D): Point3D = Point3D(Triple(x + other.x, y + other.y, z + other.z))

    /** Returns the vector from [other] to this point. */
    public operator fun minus(other: Point3D): Point3D = Point3D(Triple(x - other.x, y - other.y, z - other.z))

    /** Returns this vector multiplied by [scalar]. */
    public operator fun times(scalar: Double): Point3D = Point3D(Triple(x * scalar, y * scalar, z * scalar))

    /** Returns this vector divided by [scalar]. */
    public operator fun div(scalar: Double): Point3D = Point3D(Triple(x / scalar, y / scalar, z / scalar))

    /** Returns this vector. */
    public operator fun unaryPlus(): Point3D = this

    /** Returns the opposite vector. */
    public operator fun unaryMinus(): Point3D = Point3D(Triple(-x, -y, -z))

    /** Returns the Euclidean distance to [other]. */
    public fun distanceTo(other: Point3D): Double {
        val dx = x - other.x
        val dy = y - other.y
        val dz = z - other.z
        return sqrt(dx * dx + dy * dy + dz * dz)
    }
}
