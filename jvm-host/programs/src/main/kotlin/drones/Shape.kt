package drones

import it.unibo.collektive.stdlib.util.Point3D
import kotlin.math.atan2
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.max
import kotlin.math.sqrt

/** A surface around the origin. Shapes of one radius have about the same area. */
internal fun interface Shape {
    /** From [place] to the nearest point of the surface, or to one near it. */
    fun wayTo(place: Point3D, radius: Double): Point3D
}

/** The shapes, in order. */
internal val SHAPES: List<Shape> = listOf(
    Shape { place, radius -> place.atDistance(place.length, radius) - place },
    // A ring of three times the thickness of its tube.
    Shape { place, radius ->
        val middle = place.copy(y = 0.0).atDistance(hypot(place.x, place.z), RING * radius)
        val fromTube = place - middle
        fromTube.atDistance(fromTube.length, RING / 3 * radius) - fromTube
    },
    // A tower with a waist.
    Shape { place, radius ->
        val half = TOWER * radius
        val y = place.y.coerceIn(-half, half)
        val wide = WAIST * radius * sqrt(1 + 2 * (y / half) * (y / half))
        val onWall = place.copy(y = y).let { it.copy(y = 0.0).atDistance(hypot(it.x, it.z), wide) }.copy(y = y)
        onWall - place
    },
    // A star with four rounded points.
    Shape { place, radius ->
        val fromAxis = hypot(place.x, place.z)
        val bulge = BULGE * cos(POINTS * atan2(place.z, place.x)) * fromAxis / max(place.length, TOO_SMALL)
        place.atDistance(place.length, (1 + bulge) * radius) - place
    },
)

internal val Point3D.length: Double get() = sqrt(x * x + y * y + z * z)

private fun Point3D.copy(x: Double = this.x, y: Double = this.y, z: Double = this.z) = Point3D(Triple(x, y, z))

/** The point in the same direction at a [distance]; this one is [length] away. */
private fun Point3D.atDistance(length: Double, distance: Double) = this * (distance / max(length, TOO_SMALL))

private const val RING = 0.98
private const val TOWER = 1.5
private const val WAIST = 0.5
private const val POINTS = 4
private const val BULGE = 0.35
private const val TOO_SMALL = 1e-6
