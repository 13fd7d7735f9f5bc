package org.collektive.runtime

import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.networking.Message
import it.unibo.collektive.networking.MessageFactory
import it.unibo.collektive.networking.OutboundEnvelope
import it.unibo.collektive.networking.OutboundEnvelope.SharedData
import it.unibo.collektive.networking.PayloadRepresentation
import it.unibo.collektive.path.Path

/** The values that [senderId] sends after one round. */
internal class Envelope<ID : Any>(private val senderId: ID) : OutboundEnvelope<ID> {
    private val data = LinkedHashMap<Path, Entry<ID, *>>()

    override fun <V> addData(path: Path, data: SharedData<ID, V>, dataSharingMethod: DataSharingMethod<V>) {
        check(this.data.put(path, Entry(data, dataSharingMethod)) == null) { "device $senderId sends twice at the path '$path'" }
    }

    /** Returns the default value that is sent at [path], or `null`. */
    fun defaultAt(path: Path): PayloadRepresentation<*>? = data[path]?.default

    override fun isEmpty(): Boolean = data.isEmpty()

    override fun prepareMessageFor(receiverId: ID, factory: MessageFactory<ID, *>): Message<ID, Any?> =
        factory(senderId, data.mapValues { it.value.representationFor(receiverId) })

    private class Entry<ID : Any, V>(private val shared: SharedData<ID, V>, private val sharing: DataSharingMethod<V>) {
        val default: PayloadRepresentation<V> get() = PayloadRepresentation(shared.default, sharing)

        // Safe: addData received the method and the payload with the same type.
        @Suppress("UNCHECKED_CAST")
        fun representationFor(receiverId: ID): PayloadRepresentation<Any?> =
            PayloadRepresentation(shared[receiverId], sharing as DataSharingMethod<Any?>)
    }
}
