package drones

import it.unibo.collektive.stdlib.util.Point3D
import kotlin.math.PI
import kotlin.math.hypot
import kotlin.math.max
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * A surface around the origin. Shapes of one radius have about the same area.
 *
 * @property isRound whether drones can turn around the vertical axis and stay on the surface.
 * @property vectorToSurface returns the vector from a place to the nearest point of the surface with a radius, or to one near it.
 */
internal class Shape(val isRound: Boolean, val vectorToSurface: (place: Point3D, radius: Double) -> Point3D)

/** The shapes, in order. */
internal val SHAPES: List<Shape> = listOf(
    Shape(isRound = true) { place, radius -> place.atDistance(place.length, radius) - place },
    // A ring of three times the thickness of its tube.
    Shape(isRound = true) { place, radius ->
        val middle = place.copy(y = 0.0).atDistance(hypot(place.x, place.z), RING * radius)
        val fromTube = place - middle
        fromTube.atDistance(fromTube.length, RING / 3 * radius) - fromTube
    },
    // A square with two waves.
    Shape(isRound = false) { place, radius ->
        val half = WAVE * radius
        val x = place.x.coerceIn(-half, half)
        Point3D(Triple(x, HEIGHT * radius * sin(2 * PI * x / half), place.z.coerceIn(-half, half))) - place
    },
    // The word HI as tubes along the strokes of its letters, readable from above.
    Shape(isRound = false) { place, radius ->
        val middle = STROKES.map { it.nearestTo(place, radius) }.minBy { (place - it).length }
        val fromTube = place - middle
        fromTube.atDistance(fromTube.length, TUBE * radius) - fromTube
    },
)

/** A horizontal line between two points, in radii, parallel to an axis. */
private class Stroke(val fromX: Double, val fromZ: Double, val toX: Double, val toZ: Double) {
    fun nearestTo(place: Point3D, radius: Double) =
        Point3D(Triple(place.x.coerceIn(fromX * radius, toX * radius), 0.0, place.z.coerceIn(fromZ * radius, toZ * radius)))
}

private val STROKES = listOf(
    Stroke(-1.3, -1.2, -1.3, 1.2),
    Stroke(-1.3, 0.0, -0.1, 0.0),
    Stroke(-0.1, -1.2, -0.1, 1.2),
    Stroke(0.5, -1.2, 1.3, -1.2),
    Stroke(0.9, -1.2, 0.9, 1.2),
    Stroke(0.5, 1.2, 1.3, 1.2),
)

internal val Point3D.length: Double get() = sqrt(x * x + y * y + z * z)

private fun Point3D.copy(x: Double = this.x, y: Double = this.y, z: Double = this.z) = Point3D(Triple(x, y, z))

/** The point in the same direction at a [distance]; this one is [length] away. */
private fun Point3D.atDistance(length: Double, distance: Double) = this * (distance / max(length, TOO_SMALL))

private const val RING = 0.98
private const val WAVE = 1.5
private const val HEIGHT = 0.3
private const val TUBE = 0.19
private const val TOO_SMALL = 1e-6
