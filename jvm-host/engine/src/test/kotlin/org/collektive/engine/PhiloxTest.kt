package org.collektive.engine

import org.junit.jupiter.api.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

class PhiloxTest {
    private fun block(counter: String, key: String): String {
        val words = counter.split(' ').map { it.toUInt(16).toInt() }.toIntArray()
        val (key0, key1) = key.split(' ').map { it.toUInt(16).toInt() }
        Philox.block(words, key0, key1)
        return words.joinToString(" ") { it.toUInt().toString(16).padStart(8, '0') }
    }

    @Test
    fun `blocks match the published test vectors`() {
        assertEquals("6627e8d5 e169c58d bc57ac4c 9b00dbd8", block("0 0 0 0", "0 0"))
        assertEquals(
            "408f276d 41c83b0e a20bc7c6 6d5451fd",
            block("ffffffff ffffffff ffffffff ffffffff", "ffffffff ffffffff"),
        )
        assertEquals(
            "d16cfe09 94fdcceb 5001e420 24126ea1",
            block("243f6a88 85a308d3 13198a2e 03707344", "a4093822 299f31d0"),
        )
    }

    @Test
    fun `a stream uses the words of its blocks in order`() {
        val seed = 0x299f31d0_a4093822L
        val words = (0..2).flatMap { index ->
            intArrayOf(index, 0, 7, 1).also { Philox.block(it, 0xa4093822.toInt(), 0x299f31d0) }.toList()
        }
        val stream = Philox(seed, node = 7, purpose = 1)
        assertEquals(words, List(12) { stream.nextInt() })
    }

    @Test
    fun `a double is 53 bits of two words, high word first`() {
        val words = Philox(1, 2, 3)
        val high = words.nextInt().toUInt().toULong()
        val low = words.nextInt().toUInt().toULong()
        val expected = ((high shl 32 or low) shr 11).toDouble() / (1L shl 53)
        assertEquals(expected, Philox(1, 2, 3).nextDouble())
        val stream = Philox(5, 0, 0)
        assertTrue((0 until 10_000).all { stream.nextDouble().let { it >= 0.0 && it < 1.0 } })
    }

    @Test
    fun `streams differ by seed, node and purpose`() {
        val first = List(4) { Philox(1, 1, 0).nextLong() }
        assertEquals(first, List(4) { Philox(1, 1, 0).nextLong() })
        val others = listOf(Philox(2, 1, 0), Philox(1L shl 32, 1, 0), Philox(1, 2, 0), Philox(1, 1, 1))
        for (other in others) assertNotEquals(first.first(), other.nextLong())
    }

    @Test
    fun `the functions of Random work on a stream`() {
        val stream = Philox(9, 9, 0)
        assertTrue((0 until 1000).all { stream.nextInt(3, 10) in 3 until 10 })
        assertTrue((0 until 1000).map { stream.nextBoolean() }.toSet().size == 2)
        assertContentEquals(Philox(3, 3, 3).nextBytes(32), Philox(3, 3, 3).nextBytes(32))
        assertEquals(0, stream.nextBits(0))
    }
}
