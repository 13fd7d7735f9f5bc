package org.collektive.testkit

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
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import org.collektive.spi.RoundProgram

/**
 * Devices on Collektive's public API. [cycle] returns the function that runs one round of a device, given its id, mailbox and program:
 * `Collektive.cycle` of the implementation under test.
 *
 * @param json the format of messages; `null` passes them as objects.
 */
public class MailboxDevices(
    private val json: Json?,
    private val cycle: (id: Int, mailbox: Mailbox<Int>, program: Aggregate<Int>.() -> Any?) -> () -> Any?,
) : DeviceRuntimes {
    override fun device(id: Int): DeviceRuntime = MailboxDevice(id)

    /** Nothing to free: devices share no state. */
    override fun freeUnused(devices: List<DeviceRuntime>) {}

    private inner class MailboxDevice(private val id: Int) :
        DeviceRuntime,
        Mailbox<Int> {
        private var program: Aggregate<Int>.() -> Any? = {}
        private val cycle = cycle(id, this) { program() }
        private var inbound = Inbound(emptyList())
        private var outbound: Envelope? = null

        override fun round(inbox: Inbox, program: RoundProgram, sensors: Any?): Any? {
            this.program = { program.run(this, sensors) }
            inbound = Inbound(
                (0 until inbox.size).mapNotNull { index ->
                    (inbox.export(index) as Envelope?)?.let { deliver(it.content, if (inbox.wasKnown(index)) id else NON_NEIGHBOUR) }
                },
            )
            return cycle()
        }

        override fun commit() = checkNotNull(outbound)

        override val exports get() = checkNotNull(outbound).content.prepareMessageFor(NON_NEIGHBOUR).sharedData.size

        override fun placeOf(failure: Throwable) = null

        override val inMemory get() = json == null

        override fun deliverableFor(outboundMessage: OutboundEnvelope<Int>) {
            outbound = Envelope(outboundMessage)
        }

        override fun deliverableReceived(message: Message<Int, *>) = error("this mailbox reads messages only from the inbox")

        override fun currentInbound() = inbound
    }

    private fun deliver(envelope: OutboundEnvelope<Int>, receiver: Int): Message<Int, Any?> {
        if (json == null) return envelope.prepareMessageFor(receiver)
        val message = envelope.prepareMessageFor(receiver, SerializedMessageFactory<Int, Any?>(json)) as SerializedMessage<Int>
        val serializer = SerializedMessage.serializer(Int.serializer())
        return json.decodeFromString(serializer, json.encodeToString(serializer, message))
    }

    private class Envelope(val content: OutboundEnvelope<Int>) : Export()

    private inner class Inbound(private val messages: List<Message<Int, *>>) : NeighborsData<Int> {
        override val neighbors = messages.mapTo(LinkedHashSet()) { it.senderId }

        override fun <Value> dataAt(path: Path, dataSharingMethod: DataSharingMethod<Value>): Map<Int, Value> =
            messages.filter { path in it.sharedData }.associate { it.senderId to valueAt(path, it, dataSharingMethod) }

        @Suppress("UNCHECKED_CAST")
        private fun <Value> valueAt(path: Path, message: Message<Int, *>, sharing: DataSharingMethod<Value>): Value = when (message) {
            is InMemoryMessage -> message.sharedData[path] as Value

            is SerializedMessage -> checkNotNull(json).decodeFromString(
                (sharing as Serialize<Value>).serializer,
                message.sharedData.getValue(path).decodeToString(),
            )
        }
    }

    private companion object {
        /** Id of a receiver that was not a neighbour when the message was sent. No device has it. */
        const val NON_NEIGHBOUR = -1
    }
}
