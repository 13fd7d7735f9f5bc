@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.aggregate

import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import org.junit.jupiter.api.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

class FieldTest {
    private val device = FakeDevice(5)

    /** A field of device 5, whose neighbours 1, 3 and 1000 sent their ids times ten. Java does not cache boxes for numbers such as 1000. */
    private val f = device.field(listOf(1, 3, 1000), listOf(10, 30, 10_000), local = 50)

    @Test
    fun `entries are in ascending order, with the local one last`() {
        assertEquals(listOf(1, 3, 1000), f.neighbors.ids.list)
        assertEquals(listOf(10, 30, 10000), f.neighbors.values.list)
        assertEquals(listOf(1, 3, 1000, 5), f.all.ids.list)
        assertEquals(listOf(10, 30, 10000, 50), f.all.values.list)
        assertEquals(mapOf(1 to 10, 3 to 30, 1000 to 10000), f.neighbors.toMap())
        assertEquals(5, f.local.id)
        assertEquals(50, f.local.value)
    }

    @Test
    fun `collapses are collections`() {
        assertEquals(3, f.neighbors.size)
        assertEquals(4, f.all.size)
        assertTrue(3 in f.neighbors.ids)
        assertFalse(5 in f.neighbors.ids)
        assertTrue(5 in f.all.ids)
        assertEquals(setOf(10, 30, 10000), f.neighbors.values.set)
        assertEquals(10090, f.all.values.sequence.sum())
    }

    @Test
    fun `get finds only neighbours and the device itself`() {
        assertEquals(listOf(10, 30, 50, 10000), listOf(1, 3, 5, 1000).map { f[it] })
        val error = assertFailsWith<NoSuchElementException> { f[4] }
        assertEquals("the field has no value for device 4, only for [1, 3, 1000, 5] [node 5 at root]", error.message)
    }

    @Test
    fun `map runs once per entry`() {
        val seen = ArrayList<Int>()
        val mapped = f.map { (id, value) -> value + id.also(seen::add) }
        assertContentEquals(listOf(1, 3, 1000, 5), seen)
        assertEquals(mapOf(1 to 11, 3 to 33, 1000 to 11000, 5 to 55), mapped.all.toMap())
        assertEquals(mapOf(1 to 11, 3 to 33, 1000 to 11000, 5 to 55), mapped.all.toMap())
        assertEquals(4, seen.size)
    }

    @Test
    fun `mapValues and mapToConstant`() {
        assertEquals(listOf("10", "30", "10000", "50"), f.mapValues(Int::toString).all.values.list)
        assertEquals(listOf<Any?>(null, null, null, null), f.mapToConstant(null).all.values.list)
    }

    @Test
    fun `fields of the same devices combine`() {
        val ids = f.map { it.id }
        assertEquals(f.mapValues { it * 11 / 10 }, f.alignedMapValues(ids) { value, id -> value + id })
        assertEquals(f.mapValues { 2 * it }, f.alignedMap(f) { id, a, b -> if (id == a / 10) a + b else -1 })
        assertEquals(f.mapValues { 3 * it }, f.alignedMapValues(f, f) { a, b, c -> a + b + c })
        assertEquals(f.mapValues { 4 * it }, f.alignedMapValues(f, f, f) { a, b, c, d -> a + b + c + d })
        assertEquals(f.mapValues { 5 * it }, f.alignedMapValues(f, f, f, f) { a, b, c, d, e -> a + b + c + d + e })
        assertEquals(f.mapValues { 6 * it }, f.alignedMapValues(f, f, f, f, f) { a, b, c, d, e, g -> a + b + c + d + e + g })
        assertEquals(
            f.mapValues { 7 * it },
            f.alignedMapValues(f, f, f, f, f, f) { a, b, c, d, e, g, h -> a + b + c + d + e + g + h },
        )
    }

    @Test
    fun `fields of different devices do not combine`() {
        val alone = device.field(emptyList(), emptyList(), local = 1)
        val error = assertFailsWith<IllegalStateException> { f.alignedMapValues(alone) { a, b -> a + b } }
        assertEquals(
            "fields of different devices cannot be combined: one has values for [1, 3, 1000, 5], the other for [5]; " +
                "create both in the same branch of the program [node 5 at root]",
            error.message,
        )
    }

    @Test
    fun `a field cannot be a value of a field`() {
        assertFailsWith<IllegalStateException> { f.mapValues { f } }
        assertFailsWith<IllegalStateException> { f.mapToConstant(f) }
    }

    @Test
    fun `the function of an entry is aligned on its id, even if it throws`() {
        val paths = ArrayList<List<Any?>>()
        f.map { paths += device.path }
        assertEquals(listOf(listOf<Any?>(1), listOf(3), listOf(1000), listOf(5)), paths)
        assertFailsWith<IllegalStateException> { f.mapValues<Int> { error("broken") } }
        assertEquals(emptyList(), device.path)
    }

    @Test
    fun `a receiver without its own value gets the local one`() {
        assertEquals(listOf(10, 30, 10_000, 50, 50), listOf(1, 3, 1000, 5, 4).map(f::getOrLocal))
    }

    @Test
    fun `ids that are not numbers need no order`() {
        val named = FakeDevice("b").field(listOf("z", "a"), listOf(1, 2), local = 3)
        assertEquals(listOf(1, 2, 3), listOf("z", "a", "b").map { named[it] })
        assertFailsWith<NoSuchElementException> { named["c"] }
    }

    @Test
    fun `only a field created from one value is known to be constant`() {
        assertTrue(f.mapToConstant(1).isConstant)
        assertFalse(f.mapValues { 1 }.isConstant)
        assertEquals(3, f.mapToConstant(1).neighborCount)
    }

    @Test
    fun `fields with equal entries are equal`() {
        assertEquals(f, f.mapValues { it + 1 }.mapValues { it - 1 })
        assertEquals(f.hashCode(), f.mapValues { it }.hashCode())
        assertNotEquals(f, f.mapValues { it + 1 })
        assertNotEquals(f, f.map { if (it.id == 5) 51 else it.value }, "fields with different local values must differ")
        assertNotEquals(f, f.map { if (it.id == 3) 51 else it.value })
        assertEquals("Field(local=5: 50, neighbors={1=10, 3=30, 1000=10000})", f.toString())
    }

    @Test
    fun `an entry maps its value, and keeps its id`() {
        assertEquals(5 to 51, f.local.mapValue { it + 1 }.let { (id, value) -> id to value })
        assertEquals(5 to 55, f.local.map { it.id + it.value }.let { (id, value) -> id to value })
    }
}
