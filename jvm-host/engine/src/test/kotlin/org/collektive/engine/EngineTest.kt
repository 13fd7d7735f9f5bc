package org.collektive.engine

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.aggregate.values
import org.collektive.api.Parameters
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

@Timeout(60)
class EngineTest {
    private val seen = program { neighboring(localId).neighbors.values.list }

    @Test
    fun `in lockstep all rounds read the messages of earlier ticks`() = TestEngine(seen).use { test ->
        with(test) {
            step {
                add(1, 2, 3)
                link(1, 2)
                link(2, 3)
                due(1, 2, 3)
            }
            assertEquals<Map<Int, Any?>>(
                mapOf(1 to emptyList<Int>(), 2 to listOf(1), 3 to listOf(2)),
                step { due(1, 2, 3) }.toMap(),
            )
        }
    }

    @Test
    fun `new parameters of a node apply from their tick on and keep its state`() {
        val summing = program { device -> alignedOn("sum") { evolve(0.0) { it + device.parameters.double("step") } } }
        val nodeOne = { step: String -> NewNode(1, summing, Parameters(mapOf("step" to step))) }
        TestEngine(summing).use { test ->
            with(test) {
                step {
                    nodesAdded.add(nodeOne("1"))
                    due(1)
                }
                val changed = step {
                    nodesChanged.add(nodeOne("10"))
                    due(1)
                }
                assertEquals<Any?>(11.0, changed.toMap()[1])
                assertEquals<Any?>(21.0, step { due(1) }.toMap()[1])
            }
        }
    }

    @Test
    fun `in sequence each round reads what earlier ones sent in the same tick`() =
        TestEngine(seen, schedule = Schedule.SEQUENTIAL).use { test ->
            with(test) {
                val first = step {
                    add(3, 1, 2)
                    link(1, 2)
                    link(3, 2)
                    due(1, 2, 3)
                }
                assertEquals<Map<Int, Any?>>(mapOf(1 to emptyList<Int>(), 2 to listOf(1), 3 to emptyList<Int>()), first.toMap())
            }
        }

    @Test
    fun `neighbours still read the last messages of nodes that are not due`() = TestEngine(
        program { device ->
            neighboring(device.time).neighbors.toMap()
        },
    ).use { test ->
        with(test) {
            step {
                add(1, 2)
                link(1, 2)
                due(1)
            }
            step { }
            assertEquals<Map<Int, Any?>>(mapOf(2 to mapOf(1 to 0.5)), step { due(2) }.toMap())
        }
    }

    @Test
    fun `removing a node removes its links`() = TestEngine(seen).use { test ->
        with(test) {
            val first = step {
                add(1, 2, 3)
                link(1, 2)
                link(2, 1)
                link(3, 2)
            }
            assertEquals(3, first.linkCount)
            val second = step { nodesRemoved.add(2) }
            assertEquals(0, second.linkCount)
            assertEquals(2, second.nodeCount)
            val third = step {
                nodesRemoved.add(1)
                add(1, 2)
                link(1, 2)
            }
            assertEquals(1, third.linkCount)
        }
    }

    @Test
    fun `programs read the time, and global data once it was sent`() = TestEngine(
        program {
            "${it.time} ${it.deltaTime} ${it.globals}"
        },
    ).use { test ->
        with(test) {
            assertEquals<Any?>(
                "0.5 0.5 null",
                step {
                    add(1)
                    due(1)
                }.answer(0),
            )
            assertEquals<Any?>(
                "1.0 0.5 wind",
                step {
                    globals = "wind"
                    due(1)
                }.answer(0),
            )
            assertEquals<Any?>("1.5 0.5 wind", step { due(1) }.answer(0))
        }
    }

    @Test
    fun `random numbers depend only on the seed and the node`() {
        fun numbers(seed: Long, threads: Int) = TestEngine(program { it.random.nextInt() }, threads, seed = seed).use { test ->
            with(test) {
                val ids = IntArray(100) { it * 3 }
                step { add(*ids) }
                List(3) { step { due(*ids) }.toMap() }
            }
        }
        assertEquals(numbers(7, 1), numbers(7, 4))
        assertTrue(numbers(7, 1) != numbers(8, 1))
        assertEquals(300, numbers(7, 1).flatMap { it.values }.toSet().size)
    }

    @Test
    fun `a round that throws fails alone`() {
        val failures = listOf<() -> Any?>(
            { error("broken") },
            { throw StackOverflowError() },
            { recurse(1) },
            { List(Int.MAX_VALUE) { LongArray(1 shl 20) } },
            { throw SecurityException("System.exit is refused") },
            { null },
            { TestEngine.USELESS },
        )
        for (failure in failures) {
            for (schedule in Schedule.entries) survives(schedule, failure)
        }
    }

    private fun recurse(depth: Int): Int = recurse(depth + 1) + 1

    private fun survives(schedule: Schedule, failure: () -> Any?) {
        val broken = program { device ->
            val count = alignedOn("count") { evolve(0) { it + 1 } }
            val near = alignedOn("near") { neighboring(count).neighbors.values.list }
            if (device.id == 2 && device.time == 1.0) failure() else count to near
        }
        TestEngine(broken, threads = 2, schedule).use { test ->
            with(test) {
                step {
                    add(1, 2, 3)
                    link(2, 1)
                    link(3, 2)
                    due(1, 2, 3)
                }
                val second = step { due(1, 2, 3) }
                assertEquals(1, second.failureCount)
                assertEquals<Any?>(2 to listOf(1), second.toMap()[1], "node 1 must still see the value that node 2 sent before its failure")
                assertEquals<Any?>(2 to emptyList<Int>(), second.toMap()[3])
                val third = step { due(1, 2, 3) }
                assertEquals(0, third.failureCount)
                assertEquals(2, (third.toMap()[2] as Pair<*, *>).first, "the failed round must not count")
            }
        }
    }

    @Test
    fun `an exception whose message throws is still reported`() = TestEngine(
        program {
            throw object : RuntimeException() {
                override fun toString(): String = error("no text")
            }
        },
    ).use { test ->
        with(test) {
            val result = step {
                add(1)
                due(1)
            }
            assertTrue("no details: the exception's own code failed" in result.failure(0).orEmpty())
        }
    }

    @Test
    fun `a round that never ends is reported, and the engine can only be closed`() {
        val endless = program("endless") { device -> if (device.id == 2) spin() else 0 }
        val test = TestEngine(endless, threads = 2)
        with(test) {
            val ids = IntArray(100) { it }
            step { add(*ids) }
            val error = assertFailsWith<RoundTimeoutException> { step(limitMillis = 200) { due(*ids) } }
            assertEquals("tick 2: rounds did not finish within the time limit", error.message)
            assertTrue("in the round of node 2" in error.threads)
            assertTrue("EngineTest" in error.threads, "the stack must show the place of the loop")
            assertFailsWith<IllegalStateException> { step { due(1) } }
        }
        stop = true
    }

    @Volatile
    private var stop = false

    private fun spin(): Int {
        while (!stop) Thread.onSpinWait()
        return 0
    }

    @Test
    fun `a program that interrupts its thread does not affect later rounds`() = TestEngine(
        program {
            Thread.currentThread().interrupt()
            1
        },
    ).use { test ->
        with(test) {
            step { add(1, 2, 3) }
            repeat(20) { assertEquals(0, step { due(1, 2, 3) }.failureCount) }
        }
    }

    @Test
    fun `threads outside 1 to 256 are refused`() {
        for (threads in listOf(0, -1, 257)) {
            val error = assertFailsWith<IllegalArgumentException> { EngineSettings(1, threads) }
            assertEquals("the number of threads must be 1..256, but is $threads", error.message)
        }
    }

    @Test
    fun `a failure names its path, shortened for endless recursion`() {
        fun Aggregate<Int>.deeper(): Int = alignedOn("deeper") { deeper() } + 1
        val program = program {
            when (localId) {
                1 -> alignedOn("outer") { alignedOn("inner") { error("broken") } }
                2 -> alignedOn("outer") { deeper() }
                else -> runCatching { alignedOn("caught") { error("no") } }.isFailure
            }
        }
        TestEngine(program, threads = 2).use { test ->
            with(test) {
                repeat(2) {
                    val answers = step {
                        if (number == 1L) add(1, 2, 3)
                        due(1, 2, 3)
                    }.toMap()
                    assertEquals("java.lang.IllegalStateException: broken [node 1 at outer > inner]", answers[1])
                    val recursion =
                        Regex(
                            "java.lang.StackOverflowError \\[node 2 at outer > deeper > .*deeper > … \\([0-9,]+ more\\) > deeper > deeper]",
                        )
                    assertTrue(recursion.matches(answers[2].toString()), answers[2].toString())
                    assertEquals(true, answers[3])
                }
            }
        }
    }
}
