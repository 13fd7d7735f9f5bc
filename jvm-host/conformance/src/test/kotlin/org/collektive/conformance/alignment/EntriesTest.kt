package org.collektive.conformance.alignment

import it.unibo.collektive.Collektive
import it.unibo.collektive.aggregate.AggregateResult
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.api.share
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals

fun Aggregate<Int>.counted(start: Int): Int = share(start) { it.local.value + 1 }

val actions = listOf<Aggregate<Int>.() -> Int>({ counted(1) }, { counted(2) })

/** Tests that two programs from different lambdas are aligned where they make the same calls in the same order. */
class EntriesTest {
    private fun paths(result: AggregateResult<Int, *>) = result.toSend.prepareMessageFor(9).sharedData.keys

    private val first = Collektive.aggregate(0) { counted(1) + (if (localId == 0) neighboring(localId).neighbors.size else 0) }

    @Test
    fun `the same calls in the same order align`() {
        val second = Collektive.aggregate(0) {
            val sum = counted(7)
            sum + (if (localId < 5) neighboring("text $localId").neighbors.size else 1)
        }
        assertEquals(paths(first), paths(second))
        assertEquals(2, paths(first).size)
    }

    @Test
    fun `other calls, or another order, do not`() {
        val calls = Collektive.aggregate(0) { counted(1) + counted(2) }
        val order = Collektive.aggregate(0) { (if (localId == 0) neighboring(localId).neighbors.size else 0) + counted(1) }
        assertNotEquals(paths(first), paths(calls))
        assertEquals(1, (paths(first) intersect paths(calls)).size)
        assertEquals(emptySet(), paths(first) intersect paths(order))
    }

    @Test
    fun `different lambdas called inside a program do not align, and the same lambda does`() {
        val program: Aggregate<Int>.() -> Int = { actions[localId](this) }
        val first = paths(Collektive.aggregate(0, compute = program))
        assertEquals(emptySet(), first intersect paths(Collektive.aggregate(1, compute = program)))
        val same: Aggregate<Int>.() -> Int = { actions[0](this) }
        assertEquals(paths(Collektive.aggregate(0, compute = same)), paths(Collektive.aggregate(1, compute = same)))
    }
}
