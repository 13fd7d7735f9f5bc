package it.unibo.collektive.stdlib

import it.unibo.collektive.Collektive
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.Serialize
import it.unibo.collektive.networking.Mailbox
import it.unibo.collektive.networking.Message
import it.unibo.collektive.networking.NeighborsData
import it.unibo.collektive.networking.OutboundEnvelope
import it.unibo.collektive.networking.SerializedMessage
import it.unibo.collektive.networking.SerializedMessageFactory
import it.unibo.collektive.path.Path
import it.unibo.collektive.stdlib.accumulation.convergeCast
import it.unibo.collektive.stdlib.consensus.boundedElection
import it.unibo.collektive.stdlib.consensus.globalElection
import it.unibo.collektive.stdlib.processes.timeReplicated
import it.unibo.collektive.stdlib.spreading.bellmanFordGradientCast
import it.unibo.collektive.stdlib.spreading.distanceTo
import it.unibo.collektive.stdlib.spreading.gossipMax
import it.unibo.collektive.stdlib.spreading.hopGradientCast
import it.unibo.collektive.stdlib.spreading.nonStabilizingGossip
import it.unibo.collektive.stdlib.time.sharedClock
import it.unibo.collektive.stdlib.util.Maybe
import it.unibo.collektive.stdlib.util.Point2D
import it.unibo.collektive.stdlib.util.euclideanDistance2D
import kotlinx.serialization.SerializationException
import kotlinx.serialization.builtins.serializer
import kotlinx.serialization.json.Json
import kotlinx.serialization.serializer
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue
import kotlin.time.Duration.Companion.seconds
import kotlin.time.Instant

/** Distances without a source in reach are infinite. */
private val json = Json { allowSpecialFloatingPointValues = true }

class SerializedDeliveryTest {
    /** Devices 0, 1, 2, ... in a row, whose messages are JSON texts. */
    private class Row<R>(size: Int, program: Aggregate<Int>.() -> R) {
        private val boxes = List(size) { Box(it) }
        private val devices = boxes.map { box -> Collektive(box.id, box) { program() } }

        fun round(): List<R> {
            for (box in boxes) box.inbound = listOf(box.id - 1, box.id + 1).mapNotNull { boxes.getOrNull(it)?.textFor(box.id) }
            return devices.map { it.cycle() }
        }
    }

    private class Box(val id: Int) :
        Mailbox<Int>,
        NeighborsData<Int> {
        private val form = SerializedMessage.serializer(Int.serializer())
        private var sent: OutboundEnvelope<Int>? = null
        var inbound = emptyList<String>()
        private var messages = emptyList<SerializedMessage<Int>>()

        fun textFor(receiver: Int): String? = sent?.prepareMessageFor(receiver, SerializedMessageFactory<Int, Any?>(json))?.let {
            json.encodeToString(form, it as SerializedMessage<Int>)
        }

        override val inMemory get() = false

        override fun deliverableFor(outboundMessage: OutboundEnvelope<Int>) {
            sent = outboundMessage
        }

        override fun deliverableReceived(message: Message<Int, *>) = error("texts come through inbound")

        override fun currentInbound(): NeighborsData<Int> = apply { messages = inbound.map { json.decodeFromString(form, it) } }

        override val neighbors get() = messages.map { it.senderId }.toSet()

        override fun <Value> dataAt(path: Path, dataSharingMethod: DataSharingMethod<Value>): Map<Int, Value> =
            messages.filter { path in it.sharedData }.associate {
                it.senderId to
                    json.decodeFromString((dataSharingMethod as Serialize).serializer, it.sharedData.getValue(path).decodeToString())
            }
    }

    private fun Aggregate<Int>.everything(): List<Any?> {
        val metric = euclideanDistance2D(Point2D(localId * 1.5 to 2.0))
        val now = Instant.fromEpochSeconds(100)
        return listOf(
            alignedOn(1) { distanceTo(localId == 0, metric) },
            alignedOn(2) { hopGradientCast(localId == 0, if (localId == 0) "source" else null) },
            alignedOn(3) { bellmanFordGradientCast(localId == 0, localId, metric = metric) },
            alignedOn(4) { gossipMax(localId) },
            alignedOn(5) { nonStabilizingGossip(setOf(localId)) { a, b -> a + b } },
            alignedOn(6) { convergeCast(localId, localId == 0, Int::plus) },
            alignedOn(7) { boundedElection(2.0, metric) },
            alignedOn(8) { globalElection(-localId) },
            alignedOn(9) { sharedClock(now) },
            alignedOn(10) { timeReplicated(now, 2, 1.seconds) { gossipMax(localId) } },
        )
    }

    @Test
    fun `the library returns the same with JSON messages as in memory`() {
        val swarm = Swarm(5).line(1.5, 1.5, 1.5, 1.5)
        val row = Row(5) { everything() }
        repeat(15) {
            // All devices of a row receive before any of them sends, as in the swarm.
            assertEquals(swarm.round { everything() }.values.toList(), row.round())
        }
    }

    @Test
    fun `sharing a value without a serializer throws`() {
        class Plain
        assertFailsWith<SerializationException> { Row(1) { hopGradientCast(true, Plain()) }.round() }
    }

    @Test
    fun `an absent value, and null as a value, survive serialisation`() {
        val form = serializer<Maybe<Int?>>()
        for (value in listOf(Maybe.none, Maybe.some(null), Maybe.some(3))) {
            assertEquals(value, Json.decodeFromString(form, Json.encodeToString(form, value)))
        }
        assertTrue("values" in assertFailsWith<SerializationException> { Json.decodeFromString(form, "[1,2]") }.message.orEmpty())
    }
}
