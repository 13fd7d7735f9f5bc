package org.collektive.spi

import kotlin.test.Test
import kotlin.test.assertEquals

/** Tests that message sizes are computed as for a compact binary format. */
class MessageSizeTest {
    private enum class Colour { RED }

    private open class Named(@Suppress("unused") val name: String)

    private class Point(val x: Float, val y: Float) : Named("p") {
        @Transient
        val length = x + y

        companion object {
            const val ORIGIN = 0L
        }
    }

    private class Ring(var next: Ring? = null)

    @Test
    fun `each type has its documented size`() {
        val sizes = listOf(
            null to 1, true to 1, 3.toByte() to 1, 'x' to 2, 3.toShort() to 2, 3 to 4, 3f to 4, Colour.RED to 4, 3L to 8, 3.0 to 8,
            Unit to 0,
            "aé" to 7, listOf(1, 2) to 12, emptySet<Int>() to 4, mapOf(1 to 2.0) to 16, arrayOf("a", null) to 10,
            doubleArrayOf(1.0, 2.0) to 20,
            booleanArrayOf(true) to 5, Point(1f, 2f) to 13, (1 to 2L) to 12, 7u to 4, Result.success(3) to 4,
        )
        for ((value, bytes) in sizes) {
            val size = MessageSize()
            size.add(value)
            assertEquals(MessageSize.PATH_BYTES + bytes, size.bytes, "$value")
        }
    }

    @Test
    fun `objects of the JDK have the size of their text`() {
        val size = MessageSize()
        size.add(java.time.Duration.ofSeconds(1))
        assertEquals(MessageSize.PATH_BYTES + 4 + "PT1S".length, size.bytes)
    }

    @Test
    fun `an object that contains itself is counted once, and an object in two places twice`() {
        val ring = Ring().apply { next = Ring(this) }
        val size = MessageSize()
        size.add(ring)
        assertEquals(MessageSize.PATH_BYTES, size.bytes)
        val point = Point(1f, 2f)
        size.clear()
        size.add(listOf(point, point))
        assertEquals(MessageSize.PATH_BYTES + 4 + 2 * 13, size.bytes)
    }

    @Test
    fun `values for single receivers add their id but no path`() {
        val size = MessageSize()
        size.add(1.0)
        size.addFor(7, 2.0)
        assertEquals(1, size.values)
        assertEquals(MessageSize.PATH_BYTES + 8 + 4 + 8, size.bytes)
    }
}
