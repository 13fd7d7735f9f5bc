package it.unibo.collektive.networking

import it.unibo.collektive.aggregate.api.InMemory
import it.unibo.collektive.aggregate.api.Serialize
import it.unibo.collektive.path.Path
import it.unibo.collektive.path.tokens
import kotlinx.serialization.BinaryFormat
import kotlinx.serialization.KSerializer
import kotlinx.serialization.SerialFormat
import kotlinx.serialization.SerializationException
import kotlinx.serialization.StringFormat
import org.collektive.alignment.ProgramPlace
import org.collektive.alignment.withPlace

/**
 * Creates [SerializedMessage]s.
 *
 * @param serializerFormat encodes the values: a [BinaryFormat], or a [StringFormat] such as JSON, stored as UTF-8.
 */
public class SerializedMessageFactory<ID : Any, Payload>(private val serializerFormat: SerialFormat) : MessageFactory<ID, ByteArray> {
    /** @throws SerializationException when a value cannot be encoded; the message names its path. */
    override fun invoke(senderId: ID, sharedData: Map<Path, PayloadRepresentation<Any?>>): Message<ID, ByteArray> =
        SerializedMessage(senderId, sharedData.mapValues { (path, value) -> encode(senderId, path, value) })

    private fun encode(senderId: ID, path: Path, value: PayloadRepresentation<Any?>): ByteArray {
        try {
            return when (val representation = value.representation) {
                is Serialize -> serializerFormat.encode(representation.serializer, value.payload)
                InMemory -> throw SerializationException("its InMemory data sharing works only inside one process")
            }
        } catch (cause: SerializationException) {
            val place = ProgramPlace(senderId, path.tokens)
            throw SerializationException(withPlace("${value.payload} cannot be sent: ${cause.message}", place), cause)
        }
    }
}

private fun <T> SerialFormat.encode(serializer: KSerializer<T>, value: T): ByteArray = when (this) {
    is BinaryFormat -> encodeToByteArray(serializer, value)
    is StringFormat -> encodeToString(serializer, value).encodeToByteArray()
    else -> throw SerializationException("$this is neither a BinaryFormat nor a StringFormat")
}
