package it.unibo.collektive.stdlib.util

import kotlinx.serialization.KSerializer
import kotlinx.serialization.SerializationException
import kotlinx.serialization.builtins.ListSerializer
import kotlinx.serialization.descriptors.SerialDescriptor
import kotlinx.serialization.encoding.Decoder
import kotlinx.serialization.encoding.Encoder

/** Serialises a value as a list of one element, and its absence as an empty list. */
internal class MaybeSerializer<T>(value: KSerializer<T>) : KSerializer<Maybe<T>> {
    private val values = ListSerializer(value)
    override val descriptor: SerialDescriptor get() = values.descriptor

    override fun serialize(encoder: Encoder, value: Maybe<T>): Unit =
        encoder.encodeSerializableValue(values, value.option.fold({ emptyList() }, { listOf(it) }))

    override fun deserialize(decoder: Decoder): Maybe<T> {
        val found = decoder.decodeSerializableValue(values)
        if (found.size > 1) throw SerializationException("an optional value contains ${found.size} values; expected at most one")
        return if (found.isEmpty()) Maybe.none else Maybe.some(found[0])
    }
}
