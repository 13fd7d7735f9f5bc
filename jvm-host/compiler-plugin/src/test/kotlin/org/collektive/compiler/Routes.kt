package org.collektive.compiler

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
import org.collektive.runtime.AggregateRuntimes
import org.collektive.runtime.round
import org.collektive.spi.Export
import org.collektive.spi.Inbox

/** Devices in a row, each linked to the previous and the next one. They read the messages of the previous round. */
internal fun interface Row {
    /** Runs one round of all devices; returns what each returned. */
    fun round(program: Aggregate<Int>.() -> Any?): List<Any?>
}

/** All ways of running [size] devices in a row, by name: the reference implementations and those of users. */
internal fun rows(size: Int): Map<String, Row> {
    val ids = IntArray(size) { it }
    val reference = ReferenceDevices(*ids, linked = ::near)
    val plain = ReferenceDevices(*ids, linked = ::near, plain = true)
    return mapOf(
        "reference" to Row { reference.round(it).values.toList() },
        WITHOUT_STACK to Row { plain.round(it).values.toList() },
        "in place" to inPlace(size),
        "mailboxes" to mailboxes(size, inMemory = true),
        "mailboxes with JSON" to mailboxes(size, inMemory = false),
    )
}

internal const val WITHOUT_STACK = "reference without AlignmentStack"

private fun near(a: Int, b: Int) = a - b == 1 || b - a == 1

private fun inPlace(size: Int): Row {
    val runtimes = AggregateRuntimes()
    val devices = List(size) { runtimes.device(it) }
    val exports = arrayOfNulls<Export>(size)
    return Row { program ->
        val results = devices.mapIndexed { id, device ->
            val senders = devices.indices.filter { near(it, id) }
            val inbox = object : Inbox {
                override val size get() = senders.size
                override val ids = senders.toTypedArray<Any>()
                override fun export(index: Int) = exports[senders[index]]
                override fun wasKnown(index: Int) = true
            }
            device.round(inbox, program)
        }
        devices.forEachIndexed { id, device -> exports[id] = device.commit() }
        results
    }
}

private fun mailboxes(size: Int, inMemory: Boolean): Row {
    var running: Aggregate<Int>.() -> Any? = { null }
    val sent = arrayOfNulls<OutboundEnvelope<Int>>(size)
    val sending = arrayOfNulls<OutboundEnvelope<Int>>(size)
    val devices = List(size) { id ->
        val mailbox = object : Mailbox<Int> {
            override val inMemory = inMemory
            override fun deliverableReceived(message: Message<Int, *>) = error("messages are fetched")
            override fun deliverableFor(outboundMessage: OutboundEnvelope<Int>) {
                sending[id] = outboundMessage
            }
            override fun currentInbound() = Inbound(
                sent.indices.filter { near(it, id) }.mapNotNull { sender -> sent[sender]?.let { delivered(it, id, inMemory) } },
            )
        }
        Collektive(id, mailbox) { running() }
    }
    return Row { program ->
        running = program
        devices.map { it.cycle() }.also { sending.copyInto(sent) }
    }
}

private fun delivered(envelope: OutboundEnvelope<Int>, receiver: Int, inMemory: Boolean): Message<Int, Any?> {
    if (inMemory) return envelope.prepareMessageFor(receiver)
    val message = envelope.prepareMessageFor(receiver, SerializedMessageFactory<Int, Any?>(JSON)) as SerializedMessage<Int>
    val serializer = SerializedMessage.serializer(Int.serializer())
    return JSON.decodeFromString(serializer, JSON.encodeToString(serializer, message))
}

private val JSON = Json { allowSpecialFloatingPointValues = true }

private class Inbound(private val messages: List<Message<Int, *>>) : NeighborsData<Int> {
    override val neighbors = messages.mapTo(LinkedHashSet()) { it.senderId }

    @Suppress("UNCHECKED_CAST")
    override fun <Value> dataAt(path: Path, dataSharingMethod: DataSharingMethod<Value>): Map<Int, Value> =
        messages.filter { path in it.sharedData }.associate { message ->
            message.senderId to when (message) {
                is InMemoryMessage -> message.sharedData[path] as Value

                is SerializedMessage -> JSON.decodeFromString(
                    (dataSharingMethod as Serialize<Value>).serializer,
                    message.sharedData.getValue(path).decodeToString(),
                )
            }
        }
}
