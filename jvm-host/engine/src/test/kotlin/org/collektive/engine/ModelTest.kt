package org.collektive.engine

import it.unibo.collektive.aggregate.api.exchanging
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.toMap
import org.collektive.runtime.AggregateRuntimes
import org.collektive.runtime.DeviceRuntimes
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.TestFactory
import kotlin.test.assertEquals

/** Random runs with nodes and links coming and going, against a model made of maps, for any number of threads. */
class ModelTest {
    @TestFactory
    fun `the engine does what the model does`(): List<DynamicTest> = Schedule.entries.flatMap { schedule ->
        (1..12).map { seed ->
            DynamicTest.dynamicTest("$schedule, seed $seed") {
                val expected = Model(schedule).let { model -> Changes.random(seed, 60).map(model::step) }
                for (threads in listOf(1, 2, 8)) assertEquals(expected, run(seed, threads, schedule, AggregateRuntimes()), "$threads threads")
                assertEquals(expected, run(seed, 2, schedule, MailboxRuntimes()), "by mailboxes")
            }
        }
    }

    @TestFactory
    fun `the two schedules differ`(): List<DynamicTest> = listOf(1).map { seed ->
        DynamicTest.dynamicTest("seed $seed") {
            assert(run(seed, 2, Schedule.LOCKSTEP, AggregateRuntimes()) != run(seed, 2, Schedule.SEQUENTIAL, AggregateRuntimes()))
        }
    }

    private fun run(seed: Int, threads: Int, schedule: Schedule, runtimes: DeviceRuntimes): List<Map<Int, Any?>> {
        val program = program {
            val count = alignedOn("count") { evolve(0L) { it + 1 } }
            val sum = alignedOn("sum") {
                exchanging(localId.toLong()) { seen ->
                    val toSend = seen.map { (id, value) -> value * 31 + id }
                    toSend.yielding { seen.all.toMap() }
                }
            }
            val near = alignedOn(localId % 3) { neighboring(count).neighbors.toMap() }
            if ((count + localId) % 7 == 0L) error("every seventh")
            Triple(count, sum, near)
        }
        return TestEngine(program, threads, schedule, runtimes = runtimes).use { test ->
            Changes.random(seed, 60).map { changes -> test.step(changes).toMap().mapValues { it.value.takeIf { value -> value is Triple<*, *, *> } } }
        }
    }

    /** The same program, written as its meaning says. */
    private class Model(private val schedule: Schedule) {
        private class Sent(val count: Long, val kept: Long, val toEach: Map<Int, Long>, val known: Set<Int>)

        private val sent = HashMap<Int, Sent>()
        private val links = HashSet<Pair<Int, Int>>()
        private val nodes = sortedSetOf<Int>()

        fun step(changes: Changes): Map<Int, Any?> {
            for (id in changes.removed) {
                nodes.remove(id)
                sent.remove(id)
                cut { it.first == id || it.second == id }
            }
            nodes.addAll(changes.added)
            cut { it in changes.unlinked }
            links.addAll(changes.linked)
            val before = HashMap(sent)
            return changes.due.associateWith { id -> round(id, if (schedule == Schedule.SEQUENTIAL) sent else before) }
        }

        /** Who loses a link is unknown to its sender from then on. */
        private fun cut(gone: (Pair<Int, Int>) -> Boolean) {
            for (link in links.filter(gone)) {
                links.remove(link)
                sent[link.first]?.let { sent[link.first] = Sent(it.count, it.kept, it.toEach, it.known - link.second) }
            }
        }

        private fun round(id: Int, visible: Map<Int, Sent>): Any? {
            val own = sent[id]
            val count = (own?.count ?: 0) + 1
            val senders = links.filter { it.second == id }.map { it.first }.sorted()
            val heard = senders.mapNotNull { sender -> visible[sender]?.let { sender to it } }
            val seen = LinkedHashMap<Int, Long>()
            for ((sender, message) in heard) {
                seen[sender] = if (id in message.known) message.toEach[id] ?: message.kept else message.kept
            }
            seen[id] = own?.kept ?: id.toLong()
            val near = heard.filter { it.first % 3 == id % 3 }.associate { it.first to it.second.count }
            if ((count + id) % 7 == 0L) return null
            val toEach = seen.mapValues { it.value * 31 + it.key }
            val receivers = links.filter { it.first == id }.map { it.second }.toSet()
            sent[id] = Sent(count, toEach.getValue(id), toEach - id, receivers)
            return Triple(count, seen, near)
        }
    }
}
