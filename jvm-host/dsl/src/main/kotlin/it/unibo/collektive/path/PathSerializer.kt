package it.unibo.collektive.path

import kotlinx.serialization.KSerializer
import kotlinx.serialization.SerializationException
import kotlinx.serialization.descriptors.PrimitiveKind
import kotlinx.serialization.descriptors.PrimitiveSerialDescriptor
import kotlinx.serialization.descriptors.SerialDescriptor
import kotlinx.serialization.encoding.Decoder
import kotlinx.serialization.encoding.Encoder

/** Serialises the paths of [DigestHashingFactory] as strings; rejects all others. */
public object PathSerializer : KSerializer<Path> {
    override val descriptor: SerialDescriptor = PrimitiveSerialDescriptor("it.unibo.collektive.path.Path", PrimitiveKind.STRING)

    override fun serialize(encoder: Encoder, value: Path) {
        if (value !is SerializablePath) {
            throw SerializationException("the path '$value' contains objects, which cannot be serialised; use DigestHashingFactory")
        }
        encoder.encodeString(value.backend)
    }

    override fun deserialize(decoder: Decoder): Path = SerializablePath(decoder.decodeString())
}
