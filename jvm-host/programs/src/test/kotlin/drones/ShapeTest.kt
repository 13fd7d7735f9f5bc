package drones

import it.unibo.collektive.stdlib.util.Point3D
import org.junit.jupiter.api.Test
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class ShapeTest {
    @Test
    fun `places are on the surface`() {
        val (sphere, ring, wave, letters) = SHAPES
        for ((u, v) in grid(50)) {
            assertEquals(RADIUS, sphere.pointAt(u, v, RADIUS).length, 1e-9)
            val onRing = ring.pointAt(u, v, RADIUS)
            assertEquals(0.98 * RADIUS / 3, hypot(hypot(onRing.x, onRing.z) - 0.98 * RADIUS, onRing.y), 1e-9)
            val onWave = wave.pointAt(u, v, RADIUS)
            assertEquals(0.3 * RADIUS * sin(2 * PI * onWave.x / (1.5 * RADIUS)), onWave.y, 1e-9)
            assertTrue(abs(letters.pointAt(u, v, RADIUS).y) <= 0.19 * RADIUS)
        }
    }

    @Test
    fun `the strokes of the letters have the same places everywhere`() {
        val letters = SHAPES.last()
        // The letter H has two strokes of 2.4 radii and one of 1.2 radii. The letter I has one of 2.4 radii and two of 0.8 radii.
        assertEquals(Point3D(Triple(-1.11 * RADIUS, 0.0, -1.2 * RADIUS)).toString(), letters.pointAt(0.0, 0.0, RADIUS).toString())
        assertEquals(1.2 * RADIUS, letters.pointAt(2.4 / 10, 0.0, RADIUS).z, 1e-9)
        assertEquals(1.3 * RADIUS, letters.pointAt(1.0, 0.0, RADIUS).x, 1e-9)
    }

    @Test
    fun `drones are spread about evenly on all shapes`() {
        for ((number, shape) in SHAPES.withIndex()) {
            val cells = grid(100).map { (u, v) -> shape.pointAt(u, v, RADIUS) }.groupBy { Triple(cell(it.x), cell(it.y), cell(it.z)) }
            val area = 4 * PI * RADIUS * RADIUS
            // A cube of side a on a flat part contains about a * a / area of all places. Slopes and crossing strokes have up to three times
            // as many.
            val most = cells.values.maxOf { it.size } / 10_000.0
            assertTrue(most < 4 * CELL * CELL / area, "shape $number: $most")
        }
    }

    private fun cell(coordinate: Double) = Math.floor(coordinate / CELL)

    private fun grid(side: Int) = (0 until side * side).map { Pair((it % side + 0.5) / side, (it / side + 0.5) / side) }

    private companion object {
        const val RADIUS = 20.0
        const val CELL = 4.0
    }
}
