package org.collektive.runtime

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.ids
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.aggregate.values
import org.junit.jupiter.api.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

class FieldTest {
    /** Runs [test] on a field of device 5. Its neighbours 1, 3 and 1000 (beyond the cache of boxed ints) sent their id times ten. */
    private fun field(test: Aggregate<Int>.(Field<Int, Int>) -> Unit) {
        val network = TestNetwork(5, 1000, 1, 3)
        for (id in listOf(1, 3, 1000)) network.link(id, 5)
        network.values { neighboring(localId * 10).local.value }
        network.values(5) { test(neighboring(localId * 10)) }
    }

    @Test
    fun `entries are in ascending order, this device's last`() = field { f ->
        assertEquals(listOf(1, 3, 1000), f.neighbors.ids.list)
        assertEquals(listOf(10, 30, 10000), f.neighbors.values.list)
        assertEquals(listOf(1, 3, 1000, 5), f.all.ids.list)
        assertEquals(listOf(10, 30, 10000, 50), f.all.values.list)
        assertEquals(mapOf(1 to 10, 3 to 30, 1000 to 10000), f.neighbors.toMap())
        assertEquals(5, f.local.id)
        assertEquals(50, f.local.value)
    }

    @Test
    fun `collapses are collections`() = field { f ->
        assertEquals(3, f.neighbors.size)
        assertEquals(4, f.all.size)
        assertTrue(3 in f.neighbors.ids)
        assertFalse(5 in f.neighbors.ids)
        assertTrue(5 in f.all.ids)
        assertEquals(setOf(10, 30, 10000), f.neighbors.values.set)
        assertEquals(10090, f.all.values.sequence.sum())
    }

    @Test
    fun `get finds neighbours and the device itself, and throws for others`() = field { f ->
        assertEquals(listOf(10, 30, 50, 10000), listOf(1, 3, 5, 1000).map { f[it] })
        val error = assertFailsWith<NoSuchElementException> { f[4] }
        assertEquals("the field has no value for device 4, only for [1, 3, 1000, 5] [node 5 at root]", error.message)
    }

    @Test
    fun `map runs once per entry`() = field { f ->
        val seen = ArrayList<Int>()
        val mapped = f.map { (id, value) -> value + id.also(seen::add) }
        assertContentEquals(listOf(1, 3, 1000, 5), seen)
        assertEquals(mapOf(1 to 11, 3 to 33, 1000 to 11000, 5 to 55), mapped.all.toMap())
        assertEquals(mapOf(1 to 11, 3 to 33, 1000 to 11000, 5 to 55), mapped.all.toMap())
        assertEquals(4, seen.size)
    }

    @Test
    fun `mapValues and mapToConstant`() = field { f ->
        assertEquals(listOf("10", "30", "10000", "50"), f.mapValues(Int::toString).all.values.list)
        assertEquals(listOf<Any?>(null, null, null, null), f.mapToConstant(null).all.values.list)
    }

    @Test
    fun `fields of the same devices combine`() = field { f ->
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
    fun `fields of different devices do not combine`() = field { f ->
        val alone = alignedOn("elsewhere") { listOf(neighboring(1)) }.single()
        val error = assertFailsWith<IllegalStateException> { f.alignedMapValues(alone) { a, b -> a + b } }
        assertTrue("one has values for [1, 3, 1000, 5], the other for [5]" in error.message.orEmpty(), error.message)
    }

    @Test
    fun `a field cannot be a value of a field`() = field { f ->
        assertFailsWith<IllegalStateException> { f.mapValues { f } }
        assertFailsWith<IllegalStateException> { f.mapToConstant(f) }
    }

    @Test
    fun `fields are equal when their maps are`() = field { f ->
        assertEquals(f, f.mapValues { it + 1 }.mapValues { it - 1 })
        assertEquals(f.hashCode(), f.mapValues { it }.hashCode())
        assertNotEquals(f, f.mapValues { it + 1 })
        assertNotEquals(f, f.map { if (it.id == 5) 51 else it.value }, "the local value counts")
        assertNotEquals(f, f.map { if (it.id == 3) 51 else it.value })
        assertEquals("Field(local=5: 50, neighbors={1=10, 3=30, 1000=10000})", f.toString())
    }

    @Test
    fun `an entry maps its value, and keeps its id`() = field { f ->
        assertEquals(5 to 51, f.local.mapValue { it + 1 }.let { (id, value) -> id to value })
        assertEquals(5 to 55, f.local.map { it.id + it.value }.let { (id, value) -> id to value })
    }
}
