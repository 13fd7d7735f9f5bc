package org.collektive.engine

import it.unibo.collektive.aggregate.api.exchanging
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.toMap
import org.collektive.spi.Export
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import kotlin.math.abs
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

/** Tests which messages receivers read. Ticks are half a second apart. */
class NetworkTest {
    /** A program in which each node sends its time, and answers with the values that it received from its neighbours. */
    private val received = program { device -> neighboring(device.time).neighbors.toMap() }

    /** Returns the values that node 2 receives from node 1 in each of [ticks] ticks. Node 1 sends only in the ticks [sending]. */
    private fun receivedFrom1(
        network: NetworkModel,
        ticks: Int,
        sending: IntRange = 1..ticks,
        schedule: Schedule = Schedule.LOCKSTEP,
    ): List<Double?> = TestEngine(received, schedule = schedule, network = network).use { test ->
        with(test) {
            (1..ticks).map { number ->
                val result = step {
                    if (number == 1) {
                        add(1, 2)
                        link(1, 2)
                    }
                    if (number in sending) due(1)
                    due(2)
                }
                @Suppress("UNCHECKED_CAST")
                (result.toMap().getValue(2) as Map<Int, Double>)[1]
            }
        }
    }

    @Test
    fun `without delay a message arrives at the next tick, in sequence at the same one`() {
        // The second network has a retention, so it is not ideal, but it must deliver the same messages.
        for (network in listOf(NetworkModel(), NetworkModel(retention = 1e9))) {
            assertEquals(listOf(null, 0.5, 1.0, 1.5), receivedFrom1(network, 4))
            assertEquals<List<Double?>>(listOf(0.5, 1.0, 1.5), receivedFrom1(network, 3, schedule = Schedule.SEQUENTIAL))
        }
    }

    @Test
    fun `a delay starts at the tick of sending`() {
        assertEquals(listOf(null, 0.5, 1.0), receivedFrom1(NetworkModel(delay = 0.5), 3), "in lockstep, a message takes at least one tick")
        assertEquals(listOf(null, null, 0.5, 1.0), receivedFrom1(NetworkModel(delay = 0.6), 4))
        assertEquals(listOf(null, null, null, 0.5), receivedFrom1(NetworkModel(delay = 1.5), 4))
        assertEquals(listOf(null, 0.5), receivedFrom1(NetworkModel(delay = 0.5), 2, schedule = Schedule.SEQUENTIAL))
    }

    @Test
    fun `a message is valid for the retention after its arrival`() {
        val network = NetworkModel(retention = 1.0)
        assertEquals(listOf(null, 0.5, 0.5, null, null), receivedFrom1(network, 5, sending = 1..1))
        val late = NetworkModel(retention = 1.0, delay = 1.0)
        assertEquals(listOf(null, null, 0.5, 0.5, 0.5, null), receivedFrom1(late, 6, sending = 1..1))
    }

    @Test
    fun `a message that arrives after a more recent one is ignored`() {
        val seen = receivedFrom1(NetworkModel(jitter = 3.0), 200).filterNotNull()
        assertEquals(seen.sorted(), seen)
        assertTrue(seen.toSet().size < 150, "later messages must overtake some of the messages")
        assertTrue(seen.toSet().size > 50, "many messages must not be overtaken")
    }

    @Test
    fun `a loss of one drops every message`() = assertEquals(List(5) { null }, receivedFrom1(NetworkModel(loss = 1.0), 5))

    @Test
    fun `a lost message leaves the previous one readable`() {
        val seen = receivedFrom1(NetworkModel(loss = 0.5), 100).drop(20)
        assertTrue(null !in seen && seen.toSet().size in 20..60, "$seen")
    }

    private fun lossOf(network: NetworkModel, length: Float, attenuation: Float) = TestEngine(received, network = network).use { test ->
        with(test) {
            val ids = IntArray(100) { it }
            var sent = 0L
            var dropped = 0L
            repeat(21) { number ->
                val result = step {
                    if (number == 0) {
                        add(*ids)
                        for (from in ids) for (step in 1..5) link(from, (from + step) % 100, length, attenuation)
                    }
                    due(*ids)
                }
                sent += result.network.sent
                dropped += result.network.dropped
            }
            assertEquals(21 * 500L, sent)
            dropped / sent.toDouble()
        }
    }

    @Test
    fun `loss grows with the link's length and attenuation`() {
        val network = NetworkModel(loss = 0.1, lossPerMetre = 0.02, lossPerAttenuation = 0.05)
        for ((length, attenuation, expected) in listOf(
            Triple(0f, 0f, 0.1),
            Triple(10f, 0f, 0.3),
            Triple(0f, 4f, 0.3),
            Triple(10f, 8f, 0.7),
            Triple(99f, 0f, 1.0),
        )) {
            // The tolerance is four standard deviations of a proportion of 10,500 messages.
            assertTrue(abs(lossOf(network, length, attenuation) - expected) < 0.02, "links of $length m with attenuation $attenuation")
        }
    }

    @Test
    fun `an infinite loss per metre loses all messages, also with bursts`() {
        assertEquals(1.0, lossOf(NetworkModel(lossPerMetre = 1e308), 20f, 0f))
        assertEquals(1.0, lossOf(NetworkModel(lossPerMetre = 1e300, burstShare = 0.5, burstLength = 2.0), 20f, 0f))
    }

    @Test
    fun `every message is counted once`() {
        TestEngine(received, network = NetworkModel(delay = 0.6, retention = 0.7)).use { test ->
            with(test) {
                fun counts(fill: Tick.() -> Unit) = step(fill = fill).network.run { listOf(sent, dropped, delayed, expired) }
                assertEquals(
                    listOf(2L, 0, 2, 0),
                    counts {
                        add(1, 2, 3)
                        link(1, 2)
                        link(1, 3)
                        due(1)
                    },
                    "after one round with two links, at time 0.5",
                )
                assertEquals(listOf(0L, 0, 0, 0), counts { })
                assertEquals(listOf(0L, 0, 0, 0), counts { }, "messages that arrived at 1.1 must still be valid")
                assertEquals(listOf(0L, 0, 0, 2), counts { }, "messages that are valid until 1.8 must have expired at 2.0")
            }
        }
        TestEngine(received, network = NetworkModel(loss = 1.0)).use { test ->
            with(test) {
                val counts = step {
                    add(1, 2)
                    link(1, 2)
                    due(1)
                }.network
                assertEquals(listOf(1L, 1L, 0L, 0L), counts.run { listOf(sent, dropped, delayed, expired) })
            }
        }
    }

    @Test
    fun `an ideal network counts the messages of successful rounds`() {
        TestEngine(program { device -> if (device.id == 3) error("broken") else device.id }).use { test ->
            with(test) {
                val first = step {
                    add(1, 2, 3)
                    link(1, 2)
                    link(2, 1)
                    link(3, 1)
                    due(1, 2, 3)
                }
                assertEquals(listOf(2L, 0L, 0L, 0L), first.network.run { listOf(sent, dropped, delayed, expired) })
                assertEquals(1, step { due(1) }.network.sent)
                assertEquals(0, step { }.network.sent)
            }
        }
    }

    @Test
    fun `a new link takes its sender's last message, subject to its own loss`() {
        val network = NetworkModel(lossPerMetre = 0.01, retention = 10.0)
        TestEngine(received, network = network).use { test ->
            with(test) {
                step {
                    add(1, 2, 3)
                    due(1)
                }
                val result = step {
                    link(1, 2, 0f)
                    link(1, 3, 100f)
                    due(2, 3)
                }
                assertEquals<Map<Int, Any?>>(mapOf(2 to mapOf(1 to 0.5), 3 to emptyMap<Int, Double>()), result.toMap())
                assertEquals(listOf(2L, 1L), result.network.run { listOf(sent, dropped) })
            }
        }
    }

    @Test
    fun `a value for one receiver may arrive late, but never goes to a later neighbour`() {
        val program = program { exchanging("to all") { seen -> seen.map { "to ${it.id}" }.yielding { seen.neighbors.toMap() } } }
        TestEngine(program, network = NetworkModel(delay = 1.0)).use { test ->
            with(test) {
                step {
                    add(1, 2, 3)
                    link(1, 2)
                    link(2, 1)
                    link(3, 1)
                    due(2, 3)
                }
                step { }
                step { due(1) }
                val fourth = step {
                    link(1, 3)
                    due(2, 3)
                }.toMap()
                assertEquals<Map<Int, Any?>>(mapOf(2 to emptyMap<Int, String>(), 3 to emptyMap<Int, String>()), fourth)
                val fifth = step { due(2, 3) }.toMap()
                assertEquals<Map<Int, Any?>>(
                    mapOf(2 to mapOf(1 to "to 2"), 3 to mapOf(1 to "to 1")),
                    fifth,
                    "node 3 was not linked at that time, so it must get the default",
                )
            }
        }
    }

    @Test
    fun `no message in flight survives its link or its nodes`() {
        val network = NetworkModel(delay = 1.0)
        val ways = listOf<TestEngine.(Tick) -> Unit>(
            { it.unlink(1, 2) },
            {
                it.unlink(1, 2)
                it.link(1, 2)
            },
            {
                it.nodesRemoved.add(1)
                it.add(1)
                it.link(1, 2)
            },
            {
                it.nodesRemoved.add(2)
                it.add(2)
                it.link(1, 2)
            },
        )
        val expected = listOf(emptyMap(), mapOf(1 to 0.5), emptyMap(), mapOf(1 to 0.5))
        for ((way, received) in ways.zip(expected)) {
            TestEngine(this.received, network = network).use { test ->
                with(test) {
                    step {
                        add(1, 2)
                        link(1, 2)
                        due(1)
                    }
                    step { way(this) }
                    assertEquals<Map<Int, Any?>>(mapOf(2 to received), step { due(2) }.toMap())
                }
            }
        }
    }

    @TestFactory
    fun `losses have the requested rate and mean burst length`(): List<DynamicTest> =
        listOf(0.05 to 4.0, 0.2 to 8.0, 0.5 to 1.0, 0.6 to 2.5, 0.8 to 4.0).map { (share, length) ->
            DynamicTest.dynamicTest("$share, $length") {
                val (messages, bursts) = bursts(NetworkModel(burstShare = share, burstLength = length))
                assertEquals(share, bursts.sum().toDouble() / messages, 0.01 * share)
                assertEquals(length, bursts.average(), 0.01 * length)
            }
        }

    /** Sends messages on many links. Returns the number of messages, and the length of each sequence of lost ones. */
    private fun bursts(network: NetworkModel): Pair<Int, List<Int>> {
        val ticks = 40_000
        val links = 200
        val sender = object : Outbox() {}
        val transmitter = Transmitter(network, seed = 1, Clock())
        val channels = List(links) { Channel() }
        val lost = IntArray(links)
        val bursts = ArrayList<Int>()
        for (tick in 1L..ticks) {
            sender.send(object : Export() {}, tick, time = 0.5 * tick)
            for ((to, channel) in channels.withIndex()) {
                val dropped = transmitter.counts.dropped
                transmitter.send(1, sender, to, length = 1f, attenuation = 0f, channel)
                channel.receiveDue(now = 0.5 * tick, network.retention)
                if (transmitter.counts.dropped > dropped) {
                    lost[to]++
                } else if (lost[to] > 0) {
                    bursts += lost[to]
                    lost[to] = 0
                }
            }
        }
        return ticks * links to bursts
    }

    @TestFactory
    fun `a value out of range is refused by name`(): List<DynamicTest> {
        val nan = Double.NaN
        val cases = mapOf<String, () -> NetworkModel>(
            "loss must be 0..1, but is 1.5" to { NetworkModel(loss = 1.5) },
            "loss must be 0..1, but is -0.1" to { NetworkModel(loss = -0.1) },
            "loss must be 0..1, but is NaN" to { NetworkModel(loss = nan) },
            "loss per metre must be finite and 0 or greater, but is -1.0" to { NetworkModel(lossPerMetre = -1.0) },
            "loss per attenuation must be finite and 0 or greater, but is NaN" to { NetworkModel(lossPerAttenuation = nan) },
            "delay must be finite and 0 or greater, but is Infinity" to { NetworkModel(delay = Double.POSITIVE_INFINITY) },
            "jitter must be finite and 0 or greater, but is -0.5" to { NetworkModel(jitter = -0.5) },
            "retention must be greater than 0, but is 0.0" to { NetworkModel(retention = 0.0) },
            "burst share must be at least 0 and less than 1, but is 1.0" to { NetworkModel(burstShare = 1.0) },
            "burst share must be at least 0 and less than 1, but is NaN" to { NetworkModel(burstShare = nan) },
            "burst length must be finite, at least 1 and at least burst share / (1 - burst share), but is 0.5" to
                { NetworkModel(burstLength = 0.5) },
            "burst length must be finite, at least 1 and at least burst share / (1 - burst share), but is 2.0" to
                { NetworkModel(burstShare = 0.75, burstLength = 2.0) },
            "burst loss must be 0..1, but is 1.1" to { NetworkModel(burstLoss = 1.1) },
            "retention must be greater than 0, but is NaN" to { NetworkModel(retention = nan) },
        )
        return cases.map { (message, make) ->
            DynamicTest.dynamicTest(message) {
                assertEquals("the network's $message", assertFailsWith<IllegalArgumentException> { make() }.message)
            }
        }
    }
}
