package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.stdlib.Swarm
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals

class UtilTest {
    @Test
    fun `nonOverflowingPlus saturates at the range of Int`() {
        assertEquals(5, 2.nonOverflowingPlus(3))
        assertEquals(Int.MAX_VALUE, Int.MAX_VALUE.nonOverflowingPlus(1))
        assertEquals(Int.MIN_VALUE, Int.MIN_VALUE.nonOverflowingPlus(-1))
        assertEquals(-1, Int.MAX_VALUE.nonOverflowingPlus(Int.MIN_VALUE))
    }

    @Test
    fun `hops are 1 to neighbours and 0 to the device itself`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        assertEquals(mapOf(0 to 1, 2 to 1, 1 to 0), swarm.rounds(2) { hops().all.toMap() }.getValue(1))
    }

    @Test
    fun `distances are equal for every kind of position`() {
        val swarm = Swarm(2).line(1.0)
        val seen = swarm.rounds(2) {
            val x = 3.0 * localId
            val y = 4.0 * localId
            listOf(
                alignedOn(1) { euclideanDistance2D(Point2D(x to y)).all.toMap() },
                alignedOn(2) { euclideanDistance2D(x to y).all.toMap() },
                alignedOn(3) { euclideanDistance2D { Point2D(x to y) }.all.toMap() },
                alignedOn(4) { euclideanDistance3D(Point3D(Triple(0.0, x, y))).all.toMap() },
                alignedOn(5) { euclideanDistance3D(Triple(x, 0.0, y)).all.toMap() },
                alignedOn(6) { euclideanDistance3D { Point3D(Triple(x, y, 0.0)) }.all.toMap() },
            )
        }
        assertEquals(List(6) { mapOf(1 to 5.0, 0 to 0.0) }, seen.getValue(0))
    }

    @Test
    fun `values are coerced and replaced`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        val seen = swarm.rounds(2) {
            val field = mapNeighborhood { it * 10 }
            listOf(
                field.coerceIn(5, 15).all.toMap(),
                field.replaceMatching(-1) { it.id == 2 }.all.toMap(),
                field.replaceMatchingValues(-1) { it < 15 }.all.toMap(),
            )
        }
        val expected = listOf(
            mapOf(0 to 5, 2 to 15, 1 to 10),
            mapOf(0 to 0, 2 to -1, 1 to 10),
            mapOf(0 to -1, 2 to 20, 1 to -1),
        )
        assertEquals(expected, seen.getValue(1))
    }
}
