package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable
import kotlin.math.sqrt

/** A point in space, or a vector. */
@Serializable
@JvmInline
public value class Point3D(internal val coordinates: Triple<Double, Double, Double>) {
    /** The coordinate x. */
    public val x: Double get() = coordinates.first

    /** The coordinate y. */
    public val y: Double get() = coordinates.second

    /** The coordinate z. */
    public val z: Double get() = coordinates.third

    /** The coordinate x. */
    public operator fun component1(): Double = x

    /** The coordinate y. */
    public operator fun component2(): Double = y

    /** The coordinate z. */
    public operator fun component3(): Double = z

    /** The sum of two vectors. */
    public operator fun plus(other: Point3D): Point3D = Point3D(Triple(x + other.x, y + other.y, z + other.z))

    /** The vector from [other] to this point. */
    public operator fun minus(other: Point3D): Point3D = Point3D(Triple(x - other.x, y - other.y, z - other.z))

    /** The vector, [scalar] times as long. */
    public operator fun times(scalar: Double): Point3D = Point3D(Triple(x * scalar, y * scalar, z * scalar))

    /** The vector, divided by [scalar]. */
    public operator fun div(scalar: Double): Point3D = Point3D(Triple(x / scalar, y / scalar, z / scalar))

    /** The vector itself. */
    public operator fun unaryPlus(): Point3D = this

    /** The opposite vector. */
    public operator fun unaryMinus(): Point3D = Point3D(Triple(-x, -y, -z))

    /** The Euclidean distance to [other]. */
    public fun distanceTo(other: Point3D): Double {
        val dx = x - other.x
        val dy = y - other.y
        val dz = z - other.z
        return sqrt(dx * dx + dy * dy + dz * dz)
    }
}
