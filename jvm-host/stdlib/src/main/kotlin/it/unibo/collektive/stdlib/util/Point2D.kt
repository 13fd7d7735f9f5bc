package it.unibo.collektive.stdlib.util

import kotlinx.serialization.Serializable
import kotlin.math.sqrt

/** A point in the plane, or a vector. */
@Serializable
@JvmInline
public value class Point2D(public val coordinates: Pair<Double, Double>) {
    /** The coordinate x. */
    public val x: Double get() = coordinates.first

    /** The coordinate y. */
    public val y: Double get() = coordinates.second

    /** The coordinate x. */
    public operator fun component1(): Double = x

    /** The coordinate y. */
    public operator fun component2(): Double = y

    /** The sum of two vectors. */
    public operator fun plus(other: Point2D): Point2D = Point2D(x + other.x to y + other.y)

    /** The vector from [other] to this point. */
    public operator fun minus(other: Point2D): Point2D = Point2D(x - other.x to y - other.y)

    /** The vector, [scalar] times as long. */
    public operator fun times(scalar: Double): Point2D = Point2D(x * scalar to y * scalar)

    /** The vector, divided by [scalar]. */
    public operator fun div(scalar: Double): Point2D = Point2D(x / scalar to y / scalar)

    /** The vector itself. */
    public operator fun unaryPlus(): Point2D = this

    /** The opposite vector. */
    public operator fun unaryMinus(): Point2D = Point2D(-x to -y)

    /** The Euclidean distance to [other]. */
    public fun distanceTo(other: Point2D): Double {
        val dx = x - other.x
        val dy = y - other.y
        return sqrt(dx * dx + dy * dy)
    }
}
