package it.unibo.collektive.networking

import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.InMemory
import it.unibo.collektive.aggregate.api.Serialize
import it.unibo.collektive.networking.OutboundEnvelope.SharedData
import it.unibo.collektive.path.DigestHashingFactory
import it.unibo.collektive.path.FullPathFactory
import it.unibo.collektive.path.Path
import kotlinx.serialization.SerializationException
import kotlinx.serialization.builtins.nullable
import kotlinx.serialization.builtins.serializer
import kotlinx.serialization.json.Json
import org.junit.jupiter.api.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

/** Tests messages and their factories. */
class MessagesTest {
    private val path = DigestHashingFactory()("helper@Swarm.kt:3#0123456789abcdef", "share@Swarm.kt:12#0123456789abcdef")
    private val serialized = SerializedMessageFactory<Int, Any?>(Json)

    // The cast is needed because the factory accepts values of any type, each with its data sharing method.
    @Suppress("UNCHECKED_CAST")
    private fun <T> value(payload: T, sharing: DataSharingMethod<T>) =
        PayloadRepresentation(payload, sharing) as PayloadRepresentation<Any?>

    @Test
    fun `a message in memory contains the same objects`() {
        val payload = Any()
        assertEquals(InMemoryMessage(7, mapOf(path to payload)), InMemoryMessageFactory<Int>()(7, mapOf(path to value(payload, InMemory))))
    }

    @Test
    fun `a serialised message round-trips, including null`() {
        val data = mapOf<Path, PayloadRepresentation<Any?>>(
            path to value(42, Serialize(Int.serializer())),
            DigestHashingFactory()("other") to value(null, Serialize(String.serializer().nullable)),
        )
        val form = SerializedMessage.serializer(Int.serializer())
        val sent = serialized(7, data) as SerializedMessage<Int>
        val received = Json.decodeFromString(form, Json.encodeToString(form, sent))
        assertEquals(7, received.senderId)
        assertEquals(setOf(path, DigestHashingFactory()("other")), received.sharedData.keys)
        assertContentEquals("42".encodeToByteArray(), received.sharedData[path])
        assertContentEquals("null".encodeToByteArray(), received.sharedData[DigestHashingFactory()("other")])
    }

    @Test
    fun `a value shared for one process only cannot be sent, and the error names its place`() {
        val error = assertFailsWith<SerializationException> { serialized(7, mapOf(path to value("secret", InMemory))) }
        assertEquals(
            "secret cannot be sent: its InMemory data sharing works only inside one process [node 7 at helper > share (Swarm.kt:12)]",
            error.message,
        )
    }

    @Test
    fun `a path that holds objects cannot be sent`() {
        val message = SerializedMessage(7, mapOf(FullPathFactory("a", "b") to ByteArray(0)))
        val error = assertFailsWith<SerializationException> { Json.encodeToString(SerializedMessage.serializer(Int.serializer()), message) }
        assertEquals("the path 'a > b' contains objects, which cannot be serialised; use DigestHashingFactory", error.message)
    }

    @Test
    fun `a receiver gets its own value, which can be null, and others get the default`() {
        val data = SharedData<Int, String?>("all", mapOf(1 to "one", 2 to null))
        assertEquals(listOf("one", null, "all"), listOf(data[1], data[2], data[3]))
    }
}
