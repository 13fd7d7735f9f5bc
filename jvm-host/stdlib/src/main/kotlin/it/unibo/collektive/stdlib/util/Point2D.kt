package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable
import kotlin.math.sqrt

/** A point in the plane, or a vector. */
@Serializable
@JvmInline
public value class Point2D(public val coordinates: Pair<Double, Double>) {
    /** The x coordinate. */
    public val x: Double get() = coordinates.first

    /** The y coordinate. */
    public val y: Double get() = coordinates.second

    /** Returns the x coordinate. */
    public operator fun component1(): Double = x

    /** Returns the y coordinate. */
    public operator fun component2(): Double = y

    /** Returns the sum of this vector and [other]. */
    public operator fun plus(other: Point2D): Point2D = Point2D(x + other.x to y + other.y)

    /** Returns the vector from [other] to this point. */
    public operator fun minus(other: Point2D): Point2D = Point2D(x - other.x to y - other.y)

    /** Returns this vector multiplied by [scalar]. */
    public operator fun times(scalar: Double): Point2D = Point2D(x * scalar to y * scalar)

    /** Returns this vector divided by [scalar]. */
    public operator fun div(scalar: Double): Point2D = Point2D(x / scalar to y / scalar)

    /** Returns this vector. */
    public operator fun unaryPlus(): Point2D = this

    /** Returns the opposite vector. */
    public operator fun unaryMinus(): Point2D = Point2D(-x to -y)

    /** Returns the Euclidean distance to [other]. */
    public fun distanceTo(other: Point2D): Double {
        val dx = x - other.x
        val dy = y - other.y
        return sqrt(dx * dx + dy * dy)
    }
}
