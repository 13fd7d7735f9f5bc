package org.collektive.runtime.routes

import it.unibo.collektive.Collektive
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.Serialize
import it.unibo.collektive.networking.InMemoryMessage
import it.unibo.collektive.networking.Mailbox
import it.unibo.collektive.networking.Message
import it.unibo.collektive.networking.NeighborsData
import it.unibo.collektive.networking.OutboundEnvelope
import it.unibo.collektive.networking.SerializedMessage
import it.unibo.collektive.networking.SerializedMessageFactory
import it.unibo.collektive.path.Path
import kotlinx.serialization.builtins.serializer
import kotlinx.serialization.json.Json

/** The route of the public API: [Collektive] devices with mailboxes, whose messages are objects or JSON texts. */
internal class MailboxRoute(private val inMemory: Boolean) : Route {
    override val name = if (inMemory) "mailboxes" else "mailboxes with JSON"
    private val devices = sortedMapOf<Int, Device>()

    fun state(id: Int) = devices.getValue(id).collektive.state

    override fun add(id: Int) {
        devices[id] = Device(id)
    }

    override fun remove(id: Int) {
        devices.remove(id)
    }

    override fun round(graph: Graph, due: List<Int>, program: Aggregate<Int>.() -> Any?): Map<Int, Result<Any?>> {
        for (id in due) devices.getValue(id).collect(graph)
        val results = due.associateWith { id -> runCatching { devices.getValue(id).cycle(program) } }
        for (id in due) devices.getValue(id).flush()
        return results
    }

    private inner class Device(val id: Int) : Mailbox<Int> {
        private var program: Aggregate<Int>.() -> Any? = { null }
        private var sent: OutboundEnvelope<Int>? = null
        private var sending: OutboundEnvelope<Int>? = null
        private var inbound = Inbound(emptyList())
        val collektive = Collektive(id, this) { program() }

        fun cycle(program: Aggregate<Int>.() -> Any?): Any? {
            this.program = program
            return collektive.cycle()
        }

        fun collect(graph: Graph) {
            inbound = Inbound(emptyList())
            for (sender in graph.senders(id)) {
                val envelope = devices.getValue(sender).sent ?: continue
                deliverableReceived(delivered(envelope, if (graph.wasKnown(sender, id)) id else NOBODY))
            }
        }

        /** Messages passed to [deliverableFor] become visible only after all rounds of the step. */
        fun flush() {
            sending?.let { sent = it }
            sending = null
        }

        override val inMemory get() = this@MailboxRoute.inMemory

        override fun deliverableFor(outboundMessage: OutboundEnvelope<Int>) {
            sending = outboundMessage
        }

        override fun deliverableReceived(message: Message<Int, *>) {
            inbound = Inbound(inbound.messages + message)
        }

        override fun currentInbound(): NeighborsData<Int> = inbound
    }

    private fun delivered(envelope: OutboundEnvelope<Int>, receiver: Int): Message<Int, Any?> {
        if (inMemory) return envelope.prepareMessageFor(receiver)
        val message = envelope.prepareMessageFor(receiver, SerializedMessageFactory<Int, Any?>(Json)) as SerializedMessage<Int>
        val serializer = SerializedMessage.serializer(Int.serializer())
        return Json.decodeFromString(serializer, Json.encodeToString(serializer, message))
    }

    private class Inbound(val messages: List<Message<Int, *>>) : NeighborsData<Int> {
        override val neighbors = messages.mapTo(LinkedHashSet()) { it.senderId }

        @Suppress("UNCHECKED_CAST")
        override fun <Value> dataAt(path: Path, dataSharingMethod: DataSharingMethod<Value>): Map<Int, Value> =
            messages.filter { path in it.sharedData }.associate { message ->
                message.senderId to when (message) {
                    is InMemoryMessage -> message.sharedData[path] as Value

                    is SerializedMessage -> Json.decodeFromString(
                        (dataSharingMethod as Serialize<Value>).serializer,
                        message.sharedData.getValue(path).decodeToString(),
                    )
                }
            }
    }

    private companion object {
        const val NOBODY = -1
    }
}
