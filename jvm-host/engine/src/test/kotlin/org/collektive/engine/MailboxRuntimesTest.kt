package org.collektive.engine

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.exchanging
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.aggregate.api.sharing
import it.unibo.collektive.aggregate.values
import org.collektive.mailbox.MailboxRuntimes
import org.collektive.runtime.AggregateRuntimes
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.SharingRule
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Devices on Collektive's public API compute the same results as the project's own runtime. */
class MailboxRuntimesTest {
    @TestFactory
    fun `random programs give the same answers for hundreds of ticks with nodes and links that come and go`(): List<DynamicTest> =
        Schedule.entries.flatMap { schedule ->
            (1..6).map { seed ->
                DynamicTest.dynamicTest("$schedule, seed $seed") {
                    val own = run(seed, schedule, AggregateRuntimes())
                    assertEquals(own, run(seed, schedule, MailboxRuntimes()))
                    assertTrue(own.flatMap { it.values }.toSet().size > 200, "the programs do something")
                }
            }
        }

    private fun run(seed: Int, schedule: Schedule, runtimes: DeviceRuntimes): List<Map<Int, Any?>> {
        val piece = Pieces(Random(seed)).piece(4)
        return TestEngine(program { piece() }, 2, schedule, runtimes = runtimes).use { test ->
            // The two describe the place of an error differently.
            Changes.random(seed, 300).map { tick ->
                test.step(tick).toMap().mapValues { (_, answer) -> if (answer is String) "failed" else answer }
            }
        }
    }

    /** Random programs of all primitives. */
    private class Pieces(private val random: Random) {
        private var places = 0

        fun piece(depth: Int): Aggregate<Int>.() -> Int {
            val place = "place ${places++}"
            val k = random.nextInt(2, 7)
            if (depth == 0) return { alignedOn(place) { evolve(k) { mix(it, localId) } } }
            val a = piece(depth - 1)
            val b = piece(depth - 1)
            val body: Aggregate<Int>.() -> Int = when (random.nextInt(7)) {
                0 -> {
                    { share(a()) { seen -> seen.all.values.list.fold(k, ::mix) } }
                }

                1 -> {
                    { sharing(k) { seen -> mix(seen.local.value, k).yielding { mix(b(), seen.neighbors.size) } } }
                }

                2 -> {
                    { exchanging(k) { seen -> seen.map { mix(it.id, it.value) }.yielding { seen.all.values.list.fold(k, ::mix) } } }
                }

                3 -> {
                    { neighboring(a()).all.list.fold(k) { sum, entry -> mix(mix(sum, entry.id), entry.value) } }
                }

                4 -> {
                    { alignedOn((localId + alignedOn("way") { a() }) % k) { b() } }
                }

                5 -> {
                    { evolving(k) { old -> mix(old, a()).yielding { mix(this, localId) } } }
                }

                else -> {
                    { if (mix(localId, evolve(0) { it + 1 }) % 11 == 0) error("now and then") else mix(a(), b()) }
                }
            }
            return { alignedOn(place) { body() } }
        }
    }

    @Test
    fun `values that must not outlive a round are refused here too`() {
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
                        "a builder changes; it cannot be shared, kept or a pivot [node $id at ",
                    )
                }
                assertEquals(4, answers[4])
            }
        }
    }

    private companion object {
        fun mix(a: Int, b: Int): Int = (a * 31 + b) % 1009
    }
}
