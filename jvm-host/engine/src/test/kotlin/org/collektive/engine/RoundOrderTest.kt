package org.collektive.engine

import org.junit.jupiter.api.Test
import kotlin.math.abs
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Tests the order in which rounds run on one thread. The programs record it. */
class RoundOrderTest {
    private val ran = ArrayList<Int>()
    private val recorder = program { device -> ran += device.id }

    /** Returns the ids of the rounds of this tick, in the order in which they ran. */
    private fun TestEngine.ranIn(fill: Tick.() -> Unit): List<Int> {
        ran.clear()
        step(fill = fill)
        return ran.toList()
    }

    @Test
    fun `neighbours run close together, whatever their ids`() = TestEngine(recorder).use { engine ->
        val line = (0 until LENGTH).shuffled(Random(1))
        val order = with(engine) {
            ranIn {
                add(*line.toIntArray())
                for ((a, b) in line.zipWithNext()) {
                    link(a, b)
                    link(b, a)
                }
                due(*line.sorted().toIntArray())
            }
        }
        assertEquals(line.toSet(), order.toSet())
        // The rounds alternate between the two directions from the first node.
        for ((a, b) in line.zipWithNext()) assertTrue(abs(order.indexOf(a) - order.indexOf(b)) <= 2, "$a and $b must run close together")
    }

    @Test
    fun `each due node runs once while nodes are added and removed`() = TestEngine(recorder).use { engine ->
        val random = Random(7)
        val there = sortedSetOf<Int>()
        val links = HashSet<Pair<Int, Int>>()
        repeat(300) { turn ->
            val leaving = there.filter { random.nextInt(10) == 0 }
            val coming = List(random.nextInt(6)) { random.nextInt(60) }.filter { it !in there }.distinct()
            there -= leaving.toSet()
            there += coming
            links.removeIf { it.first !in there || it.second !in there }
            val new = List(random.nextInt(20)) { there.random(random) to there.random(random) }.filter { (a, b) ->
                a != b &&
                    a to b !in links
            }.toSet()
            links += new
            val due = if (turn % 3 == 0) there.toList() else there.filter { random.nextBoolean() }
            val order = with(engine) {
                ranIn {
                    leaving.forEach(nodesRemoved::add)
                    add(*coming.toIntArray())
                    for ((a, b) in new) link(a, b)
                    due(*due.toIntArray())
                }
            }
            assertEquals(due, order.sorted(), "tick ${engine.tick}")
        }
    }

    @Test
    fun `a sequential schedule runs by id`() = TestEngine(recorder, schedule = Schedule.SEQUENTIAL).use { engine ->
        val order = with(engine) {
            ranIn {
                add(3, 1, 2)
                link(3, 1)
                link(1, 3)
                due(1, 2, 3)
            }
        }
        assertEquals(listOf(1, 2, 3), order)
    }

    private companion object {
        const val LENGTH = 200
    }
}
