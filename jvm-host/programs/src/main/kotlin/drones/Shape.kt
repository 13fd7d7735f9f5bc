package drones

import it.unibo.collektive.stdlib.util.Point3D
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * A surface around the origin, as the image of the unit square. Evenly spread points of the square are evenly spread on the surface, and
 * near points are nearly always near there. Shapes of one radius have about the same area.
 *
 * @property isRound whether drones can turn around the vertical axis and stay on the surface: `u` is the part of a whole turn.
 * @property pointAt returns the point of the surface with a radius for `u` and `v` from 0 to 1.
 */
internal class Shape(val isRound: Boolean, val pointAt: (u: Double, v: Double, radius: Double) -> Point3D)

/** The shapes, in order. */
internal val SHAPES: List<Shape> = listOf(
    Shape(isRound = true) { u, v, radius ->
        val height = 2 * v - 1
        onCircle(u, radius * sqrt(1 - height * height), radius * height)
    },
    // A ring of three times the thickness of its tube.
    Shape(isRound = true) { u, v, radius ->
        val angle = tubeAngle(v)
        onCircle(u, RING * radius * (1 + cos(angle) / 3), RING * radius * sin(angle) / 3)
    },
    // A square with two waves.
    Shape(isRound = false) { u, v, radius ->
        val x = 2 * u - 1
        Point3D(Triple(WAVE * radius * x, HEIGHT * radius * sin(2 * PI * x), WAVE * radius * (2 * v - 1)))
    },
    // The word HI as tubes along the strokes of its letters, readable from above.
    Shape(isRound = false) { u, v, radius ->
        var along = u * STROKES.sumOf { it.length }
        var stroke = 0
        while (stroke < STROKES.lastIndex && along > STROKES[stroke].length) along -= STROKES[stroke++].length
        STROKES[stroke].pointAt(along, 2 * PI * v, radius)
    },
)

/** A horizontal line between two points, in radii, parallel to an axis. */
private class Stroke(val fromX: Double, val fromZ: Double, toX: Double, toZ: Double) {
    val isAlongX = fromZ == toZ
    val length = abs(toX - fromX) + abs(toZ - fromZ)

    /** The point of the tube at a distance from the beginning in radii, at an angle around the line. */
    fun pointAt(along: Double, angle: Double, radius: Double): Point3D {
        val aside = TUBE * cos(angle)
        val x = fromX + if (isAlongX) along else aside
        val z = fromZ + if (isAlongX) aside else along
        return Point3D(Triple(radius * x, radius * TUBE * sin(angle), radius * z))
    }
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

private fun onCircle(turn: Double, radius: Double, height: Double) =
    Point3D(Triple(radius * cos(2 * PI * turn), height, radius * sin(2 * PI * turn)))

/** The angle around the tube of the ring below which lies that part of the area: the solution of `angle + sin(angle) / 3 = 2 * PI * part`. */
private fun tubeAngle(part: Double): Double {
    var angle = 2 * PI * part
    repeat(TUBE_STEPS) { angle = 2 * PI * part - sin(angle) / 3 }
    return angle
}

private const val RING = 0.98
private const val WAVE = 1.5
private const val HEIGHT = 0.3
private const val TUBE = 0.19

/** Each step divides the error by three. */
private const val TUBE_STEPS = 20
