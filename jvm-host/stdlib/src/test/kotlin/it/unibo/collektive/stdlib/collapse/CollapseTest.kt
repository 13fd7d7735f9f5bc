package it.unibo.collektive.stdlib.collapse

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.aggregate.values
import it.unibo.collektive.stdlib.Swarm
import org.junit.jupiter.api.Test
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNull

class CollapseTest {
    /** Calls [check] with fields of random size and values, and with their entries in order: neighbours by id, then the device itself. */
    private fun fields(check: (field: Field<Int, Int>, neighbors: List<Pair<Int, Int>>, all: List<Pair<Int, Int>>) -> Unit) {
        for (seed in 0 until 40) {
            val random = Random(seed)
            val swarm = Swarm(random.nextInt(1, 8), random)
            val center = swarm.ids.random(random)
            for (id in swarm.ids) if (id != center) swarm.link(center, id)
            val values = swarm.ids.associateWith { random.nextInt(-3, 4) }
            val neighbors = (swarm.ids - center).map { it to values.getValue(it) }
            swarm.round { mapNeighborhood(values::getValue) }
            swarm.round {
                val field = mapNeighborhood(values::getValue)
                if (localId == center) check(field, neighbors, neighbors + (center to values.getValue(center)))
            }
        }
    }

    @Test
    fun `predicates and folds agree with those of lists`() = fields { field, neighbors, all ->
        for ((collapse, pairs) in listOf(field.neighbors.values to neighbors, field.all.values to all)) {
            val list = pairs.map { it.second }
            assertEquals(list.all { it > 0 }, collapse.all { it > 0 })
            assertEquals(list.any { it > 0 }, collapse.any { it > 0 })
            assertEquals(list.none { it > 0 }, collapse.none { it > 0 })
            assertEquals(list.count { it > 0 }, collapse.countMatching { it > 0 })
            assertEquals(list.fold("") { text, it -> "$text,$it" }, collapse.fold("") { text, it -> "$text,$it" })
            assertEquals(list.sum(), collapse.sum())
            assertEquals(list.fold(1, Int::times), collapse.product())
            assertEquals((list + 1).max(), collapse.max(1))
            assertEquals((list + 1).min(), collapse.min(1))
        }
        val doubles = field.mapValues { it * 0.1 }
        assertEquals(all.fold(0.0) { sum, it -> sum + it.second * 0.1 }, doubles.all.values.sum())
        assertEquals(all.fold(1.0) { product, it -> product * (it.second * 0.1) }, doubles.all.values.product())
    }

    @Test
    fun `extremes without neighbours are null, or the least or greatest number`() = fields { field, neighbors, _ ->
        val list = neighbors.map { it.second }
        val values = field.neighbors.values
        assertEquals(list.maxOrNull() ?: Int.MIN_VALUE, values.max())
        assertEquals(list.minOrNull() ?: Int.MAX_VALUE, values.min())
        val doubles = field.mapValues { it.toDouble() }.neighbors.values
        assertEquals(list.maxOrNull()?.toDouble() ?: Double.NEGATIVE_INFINITY, doubles.max())
        assertEquals(list.minOrNull()?.toDouble() ?: Double.POSITIVE_INFINITY, doubles.min())
        val texts = field.mapValues { "$it" }.neighbors.values
        assertEquals(list.maxOfOrNull { "$it" }, texts.max())
        assertEquals(list.minOfOrNull { "$it" }, texts.min())
        val nullable = field.mapValues<Int?> { it }.neighbors.values
        assertEquals<Any?>(list.isEmpty(), nullable.reduce { a, b -> a ?: b }.isNone())
        assertEquals<Any?>(list.isEmpty(), nullable.maxBy { it ?: 0 }.isNone())
        assertEquals(list.maxByOrNull { -it }, values.maxBy { -it })
        assertEquals(list.minByOrNull { -it }, values.minBy { -it })
        assertEquals(list.maxOrNull(), values.maxWith(naturalOrder()))
        assertEquals(list.minOrNull(), values.minWith(naturalOrder()))
        assertEquals(list.reduceOrNull(Int::minus), values.reduce(Int::minus))
        val entries = field.neighbors
        val max = neighbors.maxByOrNull { it.second }
        val min = neighbors.minByOrNull { it.second }
        assertEquals(listOf(max?.first, min?.first), listOf(entries.idOfMax(), entries.idOfMin()))
        assertEquals(listOf(max?.first, min?.first), listOf(entries.idOfMaxBy { it.value }, entries.idOfMinBy { it.value }))
        assertEquals(
            listOf(max?.first, min?.first),
            listOf(entries.idOfMaxWith(compareBy { it.value }), entries.idOfMinWith(compareBy { it.value })),
        )
        val byId = listOf(neighbors.maxByOrNull { it.first }?.second, neighbors.minByOrNull { it.first }?.second)
        assertEquals(byId, listOf(entries.valueOfMaxBy { it.id }, entries.valueOfMinBy { it.id }))
        assertEquals(byId, listOf(entries.valueOfMaxWith(compareBy { it.id }), entries.valueOfMinWith(compareBy { it.id })))
        if (neighbors.isEmpty()) assertNull(entries.idOfMax())
    }

    @Test
    fun `extremes of all always exist, and ties go to the first in order`() = fields { field, _, all ->
        val list = all.map { it.second }
        val values = field.all.values
        assertEquals(list.max(), values.max())
        assertEquals(list.min(), values.min())
        assertEquals(list.maxBy { -it }, values.maxBy { -it })
        assertEquals(list.minBy { -it }, values.minBy { -it })
        assertEquals(list.max(), values.maxWith(naturalOrder()))
        assertEquals(list.min(), values.minWith(naturalOrder()))
        assertEquals(list.reduce(Int::minus), values.reduce(Int::minus))
        val entries = field.all
        val ids = listOf(all.maxBy { it.second }.first, all.minBy { it.second }.first)
        assertEquals(ids, listOf(entries.idOfMaxBy { it.value }, entries.idOfMinBy { it.value }))
        assertEquals(ids, listOf(entries.idOfMaxWith(compareBy { it.value }), entries.idOfMinWith(compareBy { it.value })))
        val byId = listOf(all.maxBy { it.first }.second, all.minBy { it.first }.second)
        assertEquals(byId, listOf(entries.valueOfMaxBy { it.id }, entries.valueOfMinBy { it.id }))
        assertEquals(byId, listOf(entries.valueOfMaxWith(compareBy { it.id }), entries.valueOfMinWith(compareBy { it.id })))
    }
}
