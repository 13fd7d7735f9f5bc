package it.unibo.collektive.aggregate

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Tests the collections of a field's elements. */
class CollapseTest {
    private val field = FakeDevice(2).field(listOf(1, 3, 4), listOf("a", "b", "a"), local = "own")
    private val alone = FakeDevice(2).field(emptyList(), emptyList(), local = "own")

    @Test
    fun `neighbors contains the neighbours in order, without the device itself`() {
        assertEquals(listOf(FieldEntry(1, "a"), FieldEntry(3, "b"), FieldEntry(4, "a")), field.neighbors.list)
        assertEquals(listOf(1, 3, 4), field.neighbors.ids.list)
        assertEquals(listOf("a", "b", "a"), field.neighbors.values.list)
    }

    @Test
    fun `all contains the neighbours, then the device itself`() {
        assertEquals(field.neighbors.list + FieldEntry(2, "own"), field.all.list)
        assertEquals(listOf(1, 3, 4, 2), field.all.ids.list)
        assertEquals(listOf("a", "b", "a", "own"), field.all.values.list)
    }

    @Test
    fun `sets drop duplicates, sequences keep them`() {
        assertEquals(setOf("a", "b"), field.neighbors.values.set)
        assertEquals(listOf("a", "b", "a"), field.neighbors.values.sequence.toList())
    }

    @Test
    fun `size and contains match the elements`() {
        assertEquals(listOf(3, 4), listOf(field.neighbors.size, field.all.size))
        assertTrue("own" in field.all.values)
        assertFalse("own" in field.neighbors.values)
        assertTrue(FieldEntry(3, "b") in field.neighbors)
        assertFalse(FieldEntry(3, "a") in field.neighbors)
    }

    @Test
    fun `a map has the values by id`() {
        assertEquals(mapOf(1 to "a", 3 to "b", 4 to "a"), field.neighbors.toMap())
        assertEquals(listOf(1, 3, 4, 2), field.all.toMap().keys.toList())
    }

    @Test
    fun `without neighbours, only the device itself remains`() {
        assertEquals(emptyList(), alone.neighbors.values.list)
        assertEquals(listOf("own"), alone.all.values.list)
        assertFailsWith<IndexOutOfBoundsException> { alone.neighbors.list[0] }
    }
}
