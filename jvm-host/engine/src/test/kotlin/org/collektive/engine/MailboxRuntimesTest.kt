package org.collektive.engine

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.exchanging
import it.unibo.collektive.aggregate.api.neighboring
import org.collektive.mailbox.MailboxRuntimes
import org.collektive.runtime.AggregateRuntimes
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import org.collektive.spi.SharingRule
import org.collektive.testkit.Network
import org.collektive.testkit.Piece
import org.collektive.testkit.RandomPrograms
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/**
 * Compares devices on Collektive's public API with the project's own runtime, and the engine with the network of the test kit.
 */
class MailboxRuntimesTest {
    @TestFactory
    fun `random programs give the same answers for hundreds of ticks while nodes and links change`(): List<DynamicTest> =
        Schedule.entries.flatMap { schedule ->
            (1..6).map { seed ->
                DynamicTest.dynamicTest("$schedule, seed $seed") {
                    val piece = RandomPrograms(Random(seed)).next()
                    val own = run(seed, schedule, AggregateRuntimes(), piece)
                    assertEquals(own, run(seed, schedule, MailboxRuntimes(), piece))
                    assertEquals(own, runWithoutEngine(seed, schedule, piece))
                    assertTrue(own.flatMap { it.values }.toSet().size > 200, "the answers must vary, or the comparison proves little")
                }
            }
        }

    private fun run(seed: Int, schedule: Schedule, runtimes: DeviceRuntimes, piece: Piece): List<Map<Int, Any?>> =
        TestEngine(program { piece() ?: NOTHING }, 2, schedule, runtimes = runtimes).use { test ->
            // The runtimes describe the place of an error differently.
            Changes.random(seed, 300).map { tick ->
                test.step(tick).toMap().mapValues { (_, answer) -> if (answer is String) FAILED else answer }
            }
        }

    private fun runWithoutEngine(seed: Int, schedule: Schedule, piece: Piece): List<Map<Int, Any?>> {
        val network = Network(AggregateRuntimes())
        return Changes.random(seed, 300).map { tick ->
            tick.removed.forEach(network::remove)
            tick.added.forEach { network.add(it) }
            tick.unlinked.forEach { network.unlinkOneWay(it.from, it.to) }
            tick.linked.forEach { (line, _) -> network.linkOneWay(line.from, line.to) }
            val steps = if (schedule == Schedule.SEQUENTIAL) tick.due.map(::listOf) else listOf(tick.due)
            buildMap {
                for (due in steps) putAll(network.outcomes(due, piece).mapValues { it.value.fold({ it ?: NOTHING }, { FAILED }) })
            }
        }
    }

    @Test
    fun `both runtimes return the stored values by their paths`() {
        val program = program { alignedOn("outer") { evolve(0) { it + 1 } + alignedOn(7) { evolve(3) { it } } } }
        for (runtimes in listOf(AggregateRuntimes(), MailboxRuntimes())) {
            TestEngine(program, runtimes = runtimes).use {
                with(it) {
                    step {
                        add(3)
                        due(3)
                        inspected = 3
                    }
                }
                val state = checkNotNull(it.engine.inspect(limit = 10))
                assertEquals(mapOf("outer" to 1, "outer > 7" to 3), state.values.toMap())
                assertTrue(state.roundNanos > 0)
                assertEquals(1, it.engine.inspect(limit = 1)?.values?.size)
            }
        }
    }

    @Test
    fun `values that must not outlive a round are refused by each runtime`() {
        val rule = SharingRule { if (it is StringBuilder) "a builder changes" else null }
        val view = StringBuilder()
        val program = program {
            when (localId) {
                0 -> neighboring<Int, Any>(view).local.id
                1 -> evolve<Any>(view) { it }.hashCode()
                2 -> alignedOn(view) { evolve(0) { it } }
                3 -> exchanging<Int, Any, Int>(0) { seen -> seen.map { (id, _) -> if (id == 4) view else 0 }.yielding { 1 } }
                else -> neighboring<Int, Any>(1).local.id
            }
        }
        TestEngine(program, runtimes = MailboxRuntimes(rule)).use { test ->
            with(test) {
                step {
                    add(0, 1, 2, 3, 4)
                    link(4, 3)
                    due(4)
                }
                val answers = step { due(0, 1, 2, 3, 4) }.toMap()
                for (id in 0..3) {
                    assertContains(
                        answers[id].toString(),
                        "a builder changes; it cannot be shared, stored or used as a pivot [node $id at ",
                    )
                }
                assertEquals(4, answers[4])
            }
        }
    }

    @Test
    fun `messages that were sent before a device forgot its state are not received, on each runtime`() {
        for (runtimes in listOf(AggregateRuntimes(), MailboxRuntimes())) {
            val sender = runtimes.device(1)
            fun DeviceRuntime.hear(message: Export?) =
                round(LinkFrom1(message), { aggregate, _ -> (aggregate as Aggregate<*>).neighboring(7).neighborCount }, null)
            val messages = List(3) {
                sender.hear(null)
                sender.commit().also(Export::retain)
            }
            // This round is not committed.
            sender.hear(null)
            assertEquals(listOf<Any?>(1, 1, 1), messages.map { runtimes.device(2).hear(it) })
            sender.forget()
            assertEquals(listOf<Any?>(0, 0, 0), messages.map { runtimes.device(2).hear(it) })
        }
    }

    /** A link from device 1 with its [message]. */
    private class LinkFrom1(private val message: Export?) : Inbox {
        override val size get() = 1
        override val ids: Array<Any> = arrayOf(1)

        override fun export(index: Int) = message

        override fun wasKnown(index: Int) = true
    }

    private companion object {
        const val NOTHING = -1
        const val FAILED = "failed"
    }
}
