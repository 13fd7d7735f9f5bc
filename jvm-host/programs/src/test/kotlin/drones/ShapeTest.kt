package drones

import it.unibo.collektive.stdlib.util.Point3D
import org.junit.jupiter.api.Test
import kotlin.math.PI
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class ShapeTest {
    @Test
    fun `following the vector leads to the shape`() {
        val random = Random(1)
        for ((number, shape) in SHAPES.withIndex()) {
            repeat(200) {
                var place = Point3D(Triple(random.nextDouble(-40.0, 40.0), random.nextDouble(-40.0, 40.0), random.nextDouble(-40.0, 40.0)))
                repeat(20) { place += shape.vectorToSurface(place, RADIUS) }
                assertTrue(shape.vectorToSurface(place, RADIUS).length < 1e-6, "shape $number at $place")
            }
        }
    }

    @Test
    fun `the ways to the shapes have known lengths`() {
        val (sphere, ring, wave, letters) = SHAPES
        assertEquals(-10.0, sphere.vectorToSurface(point(30.0, 0.0, 0.0), RADIUS).x, 1e-9)
        assertEquals(0.98 * RADIUS * 4 / 3 - 40, ring.vectorToSurface(point(40.0, 0.0, 0.0), RADIUS).x, 1e-9)
        assertEquals(-10.0, wave.vectorToSurface(point(1.5 * RADIUS + 10, 3.0, 0.0), RADIUS).x, 1e-9)
        assertEquals(0.3 * RADIUS - 1, wave.vectorToSurface(point(0.375 * RADIUS, 1.0, 5.0), RADIUS).y, 1e-9)
        assertEquals(0.19 * RADIUS - 9, letters.vectorToSurface(point(-0.7 * RADIUS, 9.0, 0.0), RADIUS).y, 1e-9)
    }

    @Test
    fun `the vector from the centre of a shape is finite`() {
        for (shape in SHAPES) assertTrue(shape.vectorToSurface(point(0.0, 0.0, 0.0), RADIUS).length.isFinite())
    }

    /** Counts random points near the surface. Their number is proportional to the area. */
    @Test
    fun `all shapes have about the area of the sphere`() {
        val random = Random(2)
        val places = List(400_000) { point(random.nextDouble(-45.0, 45.0), random.nextDouble(-45.0, 45.0), random.nextDouble(-45.0, 45.0)) }
        val areas = SHAPES.map { shape -> places.count { shape.vectorToSurface(it, RADIUS).length < 0.5 } / 400_000.0 * 90 * 90 * 90 }
        assertEquals(4 * PI * RADIUS * RADIUS, areas.first(), 400.0)
        for ((number, area) in areas.withIndex()) assertEquals(1.0, area / areas.first(), 0.35, "shape $number")
    }

    private fun point(x: Double, y: Double, z: Double) = Point3D(Triple(x, y, z))

    private companion object {
        const val RADIUS = 20.0
    }
}
