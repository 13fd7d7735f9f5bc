package it.unibo.collektive.stdlib

import it.unibo.collektive.Collektive
import it.unibo.collektive.aggregate.api.Aggregate
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
import kotlinx.serialization.json.Json
import kotlinx.serialization.serializer
import org.collektive.testkit.MailboxDevices
import org.collektive.testkit.Network
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue
import kotlin.time.Duration.Companion.seconds
import kotlin.time.Instant

/** The format of messages. It allows infinity, which is the distance of a device that cannot reach a source. */
private val json = Json { allowSpecialFloatingPointValues = true }

class SerializedDeliveryTest {
    /** Creates devices that exchange messages as JSON texts. */
    private fun network(vararg ids: Int) = Network(
        MailboxDevices(json) { id, mailbox, program -> Collektive(id, mailbox, computeFunction = program)::cycle },
        *ids,
    )

    private fun Aggregate<Int>.runAllFunctions(): List<Any?> {
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
        val row = network(0, 1, 2, 3, 4).line(0, 1, 2, 3, 4)
        repeat(15) { assertEquals(swarm.round { runAllFunctions() }, row.round { runAllFunctions() }) }
    }

    @Test
    fun `sharing a value without a serializer throws`() {
        class Plain
        assertFailsWith<SerializationException> { network(0).round { hopGradientCast(true, Plain()) } }
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
