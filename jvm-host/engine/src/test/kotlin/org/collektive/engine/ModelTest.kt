package org.collektive.engine

import it.unibo.collektive.aggregate.api.exchanging
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.toMap
import org.collektive.mailbox.MailboxRuntimes
import org.collektive.runtime.AggregateRuntimes
import org.collektive.spi.DeviceRuntimes
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals

/**
 * Compares random runs, in which nodes and links come and go, with a simple model. Runs on several numbers of threads and with several
 * networks.
 */
class ModelTest {
    private val networks = mapOf(
        "ideal" to NetworkModel(),
        "almost ideal" to NetworkModel(retention = 1e9),
        "lossy" to NetworkModel(loss = 0.3, lossPerMetre = 0.02, lossPerAttenuation = 0.1),
        "slow" to NetworkModel(delay = 0.7, jitter = 2.0),
        "forgetful" to NetworkModel(jitter = 0.4, retention = 0.8),
        "bursty" to NetworkModel(loss = 0.1, burstShare = 0.4, burstLength = 3.0, burstLoss = 0.8),
        "bad" to NetworkModel(loss = 0.2, lossPerMetre = 0.01, lossPerAttenuation = 0.05, delay = 0.5, jitter = 1.6, retention = 1.5),
    )

    @TestFactory
    fun `engine and model agree`(): List<DynamicTest> = Schedule.entries.flatMap { schedule ->
        networks.flatMap { (name, network) ->
            (1..4).map { seed ->
                DynamicTest.dynamicTest("$schedule, $name, seed $seed") {
                    val expected = Model(schedule, network).let { model -> Changes.random(seed, TICKS).map(model::step) }
                    for (threads in listOf(1, 2, 4, 8)) assertEquals(expected, run(seed, threads, schedule, network), "$threads threads")
                    assertEquals(expected, run(seed, 2, schedule, network, runtimes = MailboxRuntimes()), "on the mailbox runtime")
                }
            }
        }
    }

    @TestFactory
    fun `changes may come in any order`(): List<DynamicTest> = Schedule.entries.flatMap { schedule ->
        networks.map { (name, network) ->
            DynamicTest.dynamicTest("$schedule, $name") {
                val expected = run(seed = 5, threads = 1, schedule, network)
                for (order in 1..3) assertEquals(expected, run(seed = 5, threads = 4, schedule, network, Random(order)))
            }
        }
    }

    @Test
    fun `schedules and networks differ`() {
        val runs = networks.filterKeys { it != "almost ideal" }.values.map { run(1, 2, Schedule.LOCKSTEP, it) } +
            listOf(run(1, 2, Schedule.SEQUENTIAL, NetworkModel()))
        for (a in runs.indices) for (b in 0 until a) assertNotEquals(runs[a], runs[b], "runs $a and $b must differ")
    }

    @Test
    fun `a network model without loss and delay equals the ideal network`() {
        for (schedule in Schedule.entries) {
            assertEquals(run(2, 2, schedule, NetworkModel()), run(2, 2, schedule, networks.getValue("almost ideal")))
        }
    }

    /** The outcome of a tick: the answers, and the numbers of sent, dropped, delayed and expired messages. */
    private data class Outcome(val answers: Map<Int, Any?>, val counts: List<Long>)

    private fun run(
        seed: Int,
        threads: Int,
        schedule: Schedule,
        network: NetworkModel,
        order: Random? = null,
        runtimes: DeviceRuntimes = AggregateRuntimes(),
    ): List<Outcome> {
        val program = program { device ->
            val count = alignedOn("count") { evolve(0L) { it + 1 } }
            val sum = alignedOn("sum") {
                exchanging(localId.toLong()) { seen ->
                    val toSend = seen.map { (id, value) -> value * 31 + id }
                    toSend.yielding { seen.all.toMap() }
                }
            }
            val near = alignedOn(localId % 3) { neighboring(count).neighbors.toMap() }
            if (((device.time * 2).toInt() + localId) % 7 == 0) error("every seventh")
            listOf(count, sum, near, device.globals, device.deltaTime)
        }
        return TestEngine(program, threads, schedule, SEED, runtimes, network).use { test ->
            Changes.random(seed, TICKS).map { changes ->
                val result = test.step(changes, order)
                val counts = result.network.run { listOf(sent, dropped, delayed, expired) }
                Outcome(result.toMap().mapValues { it.value.takeIf { value -> value is List<*> } }, counts)
            }
        }
    }

    /** The same program and network, implemented directly from their specification. */
    private class Model(private val schedule: Schedule, private val network: NetworkModel) {
        private class Message(val tick: Int, val count: Long, val kept: Long, val toEach: Map<Int, Long>, val receivers: Set<Int>)

        /** All messages of a link with their times of arrival. */
        private class Link(var values: Values, val since: Int) {
            val arrivals = ArrayList<Pair<Message, Double>>()
            var newest: Message? = null
            var current: Pair<Message, Double>? = null
            var isBad: Boolean? = null
        }

        private val last = HashMap<Int, Message>()
        private val links = HashMap<Line, Link>()
        private val nodes = sortedSetOf<Int>()
        private var globals: Int? = null
        private var tick = 0
        private val now get() = tick * 0.5
        private val counts = LongArray(4)

        fun step(changes: Changes): Outcome {
            tick++
            counts.fill(0)
            changes.globals?.let { globals = it }
            nodes.removeAll(changes.removed.toSet())
            last.keys.removeAll(changes.removed.toSet())
            links.keys.removeIf { it.from in changes.removed || it.to in changes.removed }
            nodes.addAll(changes.added)
            links.keys.removeAll(changes.unlinked.toSet())
            for ((line, values) in changes.linked) {
                val known = links[line]
                if (known != null) {
                    known.values = values
                    continue
                }
                val link = Link(values, tick)
                links[line] = link
                last[line.from]?.let { put(it, line, link) }
            }
            val answers = LinkedHashMap<Int, Any?>()
            val sent = ArrayList<Pair<Int, Message>>()
            for (id in changes.due) {
                links.filterKeys { it.to == id }.values.forEach(::settle)
                val (answer, message) = round(id)
                answers[id] = answer
                if (message == null) continue
                if (schedule == Schedule.SEQUENTIAL) publish(id, message) else sent += id to message
            }
            sent.forEach { publish(it.first, it.second) }
            links.values.forEach(::settle)
            return Outcome(answers, counts.toList())
        }

        private fun publish(id: Int, message: Message) {
            last[id] = message
            links.filterKeys { it.from == id }.forEach { (line, link) -> put(message, line, link) }
        }

        private fun put(message: Message, line: Line, link: Link) {
            counts[0]++
            val (first, second) = numbers(message, line, purpose = 4)
            val loss = network.loss + network.lossPerMetre * link.values.length + network.lossPerAttenuation * link.values.attenuation
            val state = numbers(message, line, purpose = 5).first()
            link.isBad = when (link.isBad) {
                null -> state < network.burstShare
                true -> state >= 1 / network.burstLength
                false -> state < 1 / network.burstLength * network.burstShare / (1 - network.burstShare)
            }
            if (first < loss + if (link.isBad == true) (1 - loss) * network.burstLoss else 0.0) {
                counts[1]++
                return
            }
            val delay = network.delay + network.jitter * second
            if (delay > 0) counts[2]++
            link.arrivals += message to message.tick * 0.5 + delay
        }

        private fun numbers(message: Message, line: Line, purpose: Int): List<Double> {
            val words = intArrayOf(message.tick, line.from, line.to, purpose)
            Philox.block(words, SEED.toInt(), 0)
            return words.map { it.toUInt().toDouble() }.chunked(2).map { (high, low) ->
                (high * 4294967296.0 + (low - low % 2048.0)) / 18446744073709551616.0
            }
        }

        /** Selects the newest message that has arrived and has not expired. */
        private fun settle(link: Link) {
            val arrived = link.arrivals.filter { it.second <= now + 0.0005 }.maxByOrNull { it.first.tick } ?: return
            if (arrived.first !== link.newest) {
                link.newest = arrived.first
                link.current = arrived
            }
            val current = link.current
            if (current != null && current.second + network.retention < now - 0.0005) {
                link.current = null
                counts[3]++
            }
        }

        private fun round(id: Int): Pair<Any?, Message?> {
            val own = last[id]
            val count = (own?.count ?: 0) + 1
            val incoming = links.filterKeys { it.to == id }.toSortedMap(compareBy(Line::from))
            val received = incoming.mapNotNull { (line, link) -> link.current?.let { Triple(line.from, link, it.first) } }
            val seen = LinkedHashMap<Int, Long>()
            for ((sender, link, message) in received) {
                val isKnown = id in message.receivers && link.since <= message.tick
                seen[sender] = if (isKnown) message.toEach[id] ?: message.kept else message.kept
            }
            seen[id] = own?.kept ?: id.toLong()
            val near = received.filter { it.first % 3 == id % 3 }.associate { it.first to it.third.count }
            if ((tick + id) % 7 == 0) return null to null
            val toEach = seen.mapValues { it.value * 31 + it.key }
            val receivers = links.keys.filter { it.from == id }.map { it.to }.toSet()
            val deltaTime = if (own == null) 0.5 else now - own.tick * 0.5
            val message = Message(tick, count, toEach.getValue(id), toEach - id, receivers)
            return listOf(count, seen, near, globals, deltaTime) to message
        }
    }

    private companion object {
        const val SEED = 9L
        const val TICKS = 60
    }
}
