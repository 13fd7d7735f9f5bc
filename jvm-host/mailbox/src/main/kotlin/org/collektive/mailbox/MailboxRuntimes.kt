package org.collektive.mailbox

import it.unibo.collektive.Collektive
import it.unibo.collektive.aggregate.AggregateResult
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.networking.Mailbox
import it.unibo.collektive.networking.Message
import it.unibo.collektive.networking.NeighborsData
import it.unibo.collektive.networking.OutboundEnvelope
import it.unibo.collektive.path.FullPathFactory
import it.unibo.collektive.path.Path
import it.unibo.collektive.path.PathFactory
import it.unibo.collektive.state.State
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import org.collektive.spi.MessageSize
import org.collektive.spi.RoundProgram
import org.collektive.spi.SharingRule

/**
 * Runs devices only through Collektive's public API ([Collektive], [Mailbox]), so it works with any implementation on the class path.
 * Results equal those of the built-in runtime. A round is many times as expensive, because messages are copied for each receiver.
 */
public class MailboxRuntimes(private val rule: SharingRule = SharingRule { null }) : DeviceRuntimes {
    override fun device(id: Int): DeviceRuntime = MailboxRuntime(id, rule)

    /** Nothing to free: devices share no state. */
    override fun freeUnused(devices: List<DeviceRuntime>) {}
}

private class MailboxRuntime(private val id: Int, private val rule: SharingRule) :
    DeviceRuntime,
    Mailbox<Int>,
    PathFactory {
    private var inbound = Inbound(emptyList())
    private var state: State = emptyMap()
    private var newState: State = emptyMap()
    private var outbound = Messages(emptyMap(), null)

    // The messages of the last two committed rounds, and older ones that receivers have not read.
    private val readable = ArrayList<Messages>(2)

    // The path of the last primitive, reported as the place of a failure. The API provides no further details.
    private var reached: Path? = null

    override fun round(inbox: Inbox, program: RoundProgram, sensors: Any?): Any? {
        val messages = (0 until inbox.size).mapNotNull { (inbox.export(it) as Messages?)?.message(if (inbox.wasKnown(it)) id else NO_ID) }
        inbound = Inbound(messages)
        reached = null
        val round: AggregateResult<Int, Any?> =
            Collektive.aggregate(localId = id, network = this, previousState = state, pathFactory = this) { program.run(this, sensors) }
        for ((path, value) in round.newState) requireShareable(path, value)
        newState = round.newState
        return round.result
    }

    override val exports: Int get() = outbound.message(NO_ID)?.sharedData.orEmpty().size

    override fun placeOf(failure: Throwable): String = place(reached)

    override fun commit(): Export {
        state = newState
        val last = readable.lastOrNull()
        readable.removeIf { it !== last && !it.isRetained }
        readable += outbound
        return outbound
    }

    override fun state(limit: Int): List<Pair<String, Any?>> =
        state.entries.take(limit).map { (path, value) -> path.toMultilineString(" > ") to value }

    override fun forget() {
        state = emptyMap()
        newState = emptyMap()
        inbound = Inbound(emptyList())
        outbound.clear()
        readable.forEach(Messages::clear)
        readable.clear()
        reached = null
    }

    override val inMemory: Boolean get() = true

    override fun currentInbound(): NeighborsData<Int> = inbound

    override fun deliverableReceived(message: Message<Int, *>) = error("this mailbox reads messages only from the links")

    /** Creates all messages in advance, because an envelope need not support concurrent readers. */
    override fun deliverableFor(outboundMessage: OutboundEnvelope<Int>) {
        val default = outboundMessage.prepareMessageFor(NO_ID)
        val each = inbound.neighbors.associateWith { outboundMessage.prepareMessageFor(it) }
        for (message in each.values + default) for ((path, value) in message.sharedData) requireShareable(path, value)
        outbound = Messages(each, default)
    }

    /** Returns the path of [tokens], which include the program's pivots. */
    override fun invoke(tokens: List<Any?>): Path {
        val path = FullPathFactory(tokens)
        reached = path
        for (token in tokens) requireShareable(path, token)
        return path
    }

    private fun requireShareable(path: Path, value: Any?) {
        val refusal = rule.refusal(value) ?: return
        throw IllegalArgumentException("$refusal; it cannot be shared, stored or used as a pivot [${place(path)}]")
    }

    private fun place(path: Path?): String = "node $id" + if (path == null) "" else " at ${path.toMultilineString(" > ")}"

    /** The messages of one round: those for [each] neighbour of that round, and the [default] for all other receivers. */
    private class Messages(private var each: Map<Int, Message<Int, *>>, private var default: Message<Int, *>?) : Export() {
        fun message(receiver: Int): Message<Int, *>? = each[receiver] ?: default

        fun clear() {
            each = emptyMap()
            default = null
        }

        override fun measure(size: MessageSize) {
            for ((path, value) in default?.sharedData.orEmpty()) {
                size.add(value)
                for ((receiver, message) in each) {
                    val own = message.sharedData[path]
                    if (own != value) size.addFor(receiver, own)
                }
            }
        }
    }

    private class Inbound(private val messages: List<Message<Int, *>>) : NeighborsData<Int> {
        override val neighbors: Set<Int> = messages.mapTo(LinkedHashSet()) { it.senderId }

        @Suppress("UNCHECKED_CAST")
        override fun <Value> dataAt(path: Path, dataSharingMethod: DataSharingMethod<Value>): Map<Int, Value> =
            messages.filter { path in it.sharedData }.associate { it.senderId to it.sharedData[path] as Value }
    }

    private companion object {
        /** Stands for receivers that were not neighbours when the message was sent. Not the id of a device. */
        const val NO_ID = -1
    }
}
