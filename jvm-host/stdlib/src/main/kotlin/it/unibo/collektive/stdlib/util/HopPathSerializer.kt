package it.unibo.collektive.stdlib.util

import kotlinx.serialization.KSerializer
import kotlinx.serialization.builtins.ListSerializer
import kotlinx.serialization.descriptors.SerialDescriptor
import kotlinx.serialization.encoding.Decoder
import kotlinx.serialization.encoding.Encoder

/** Serialises a path as the list of its hops. */
internal class HopPathSerializer<ID : Any>(id: KSerializer<ID>) : KSerializer<HopPath<ID>> {
    private val hops = ListSerializer(id)
    override val descriptor: SerialDescriptor get() = hops.descriptor

    override fun serialize(encoder: Encoder, value: HopPath<ID>): Unit = encoder.encodeSerializableValue(hops, value.toList())

    override fun deserialize(decoder: Decoder): HopPath<ID> = HopPath.of(decoder.decodeSerializableValue(hops))
}
