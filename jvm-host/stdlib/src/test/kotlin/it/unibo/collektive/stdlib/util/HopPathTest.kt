package it.unibo.collektive.stdlib.util

import org.collektive.spi.MessageSize
import org.junit.jupiter.api.Assertions.assertTimeoutPreemptively
import org.junit.jupiter.api.Test
import java.time.Duration.ofSeconds
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class HopPathTest {
    private fun path(ids: List<Int>) = ids.fold(HopPath.empty<Int>()) { path, id -> path + id }

    private fun commonInOrder(a: List<Int>, b: List<Int>) = a.filter { it in b } == b.filter { it in a }

    @Test
    fun `a path is the list of its hops`() {
        val random = Random(1)
        repeat(200) {
            val ids = (0 until 1000).shuffled(random).take(random.nextInt(0, 60))
            val path = path(ids)
            assertEquals(ids, path.toList())
            assertEquals(ids.size, path.size)
            assertEquals(path(ids), path)
            assertEquals(path(ids).hashCode(), path.hashCode())
            for (id in 0 until 1000) assertEquals(id in ids, id in path)
        }
    }

    @Test
    fun `iterating over a path takes linear time`() {
        val ids = (0 until 100_000).toList()
        assertTimeoutPreemptively(ofSeconds(10)) { assertEquals(ids, path(ids).map { it }) }
    }

    @Test
    fun `paths agree when their common hops are in the same order`() {
        val random = Random(2)
        var agreeing = 0
        repeat(2000) {
            val pool = (0 until 6).toList()
            val a = pool.shuffled(random).take(random.nextInt(1, 6))
            val b = pool.shuffled(random).take(random.nextInt(1, 6))
            if (a.last() != b.last()) {
                assertEquals(commonInOrder(a, b), path(a.dropLast(1)).hasSameHopOrder(a.last(), path(b.dropLast(1)), b.last()), "$a and $b")
                if (commonInOrder(a, b)) agreeing++
            }
        }
        assertTrue(agreeing in 300..1500, "$agreeing")
    }

    @Test
    fun `branches of one path agree`() {
        val stem = path((0 until 20).toList())
        assertTrue((stem + 50).hasSameHopOrder(51, stem, 60))
        assertTrue(stem.hasSameHopOrder(50, stem, 51))
        assertFalse((stem + 50).hasSameHopOrder(51, stem + 51, 50))
    }

    @Test
    fun `a path extends the one that it was made from`() {
        val stem = path(listOf(1, 2))
        assertTrue((stem + 3).extends(stem, 3))
        assertFalse((stem + 3).extends(stem, 4))
        assertFalse((path(listOf(1, 2)) + 3).extends(stem, 3), "a path must not extend an equal path that is a different object")
    }

    @Test
    fun `hops count once in the size of a message`() {
        val size = MessageSize()
        size.add(PathValue(1.0, 2.0, HopPath.of(listOf(3, 4))))
        assertEquals(MessageSize.PATH_BYTES + 2 * Double.SIZE_BYTES + 3 * Int.SIZE_BYTES, size.bytes)
    }
}
