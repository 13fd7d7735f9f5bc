package org.collektive.engine

import org.collektive.api.LinkSnapshot
import org.collektive.spi.Export
import org.collektive.spi.Inbox

/** The links into the node [receiver], in ascending order of the senders' ids. An ideal network has no channels. */
internal class IncomingLinks(private val receiver: Int, isIdeal: Boolean, private val clock: Clock) :
    NodeList(),
    Inbox {
    private var lengths = FloatArray(keys.size)
    private var attenuations = FloatArray(keys.size)

    // The tick in which each link was added.
    private var since = LongArray(keys.size)

    // The number of the last validation that marked each link; see TickValidator.
    private var marks = LongArray(keys.size)
    private var channels = if (isIdeal) null else arrayOfNulls<Channel>(keys.size)
    private var boxedIds: Array<Any>? = NONE

    override val ids: Array<Any>
        get() = boxedIds ?: Array<Any>(size) { node(it).boxedId }.also { boxedIds = it }

    override fun export(index: Int): Export? = if (channels == null) node(index).readable(clock.readsBefore) else channel(index).received

    override fun wasKnown(index: Int): Boolean =
        since[index] <= if (channels == null) node(index).readable(clock.readsBefore)?.tick ?: 0 else channel(index).receivedTick

    /** Returns the length of link [index] in metres. */
    fun length(index: Int): Float = lengths[index]

    /** Returns the attenuation of link [index]. */
    fun attenuation(index: Int): Float = attenuations[index]

    /** Returns a copy of the links. */
    fun snapshot(): List<LinkSnapshot> = List(size) { LinkSnapshot(keys[it], lengths[it].toDouble(), attenuations[it].toDouble()) }

    /** Moves new exports of the senders to the channels. Does nothing in an ideal network. Call it only while no sender's round runs. */
    fun collect(transmitter: Transmitter) {
        if (channels == null) return
        for (index in 0 until size) if (node(index).sentAt > channel(index).lastSentTick) collect(index, transmitter)
    }

    /** Receives the messages that are due. Does nothing in an ideal network. */
    fun advance(transmitter: Transmitter) {
        if (channels == null) return
        for (index in 0 until size) transmitter.advance(channel(index))
    }

    private fun collect(index: Int, transmitter: Transmitter) {
        val channel = channel(index)
        channel.lastSentTick = node(index).sentAt
        transmitter.send(node(index).id, node(index), receiver, lengths[index], attenuations[index], channel)
    }

    private fun channel(index: Int): Channel = channels?.get(index) ?: error("no channel for link $index of $size")

    /** See [Export.touch]. */
    fun prefetch(): Int = (boxedIds?.size ?: 0) + (if (nodes[0] === nodes[maxOf(0, size - 1)]) 1 else 0)

    fun mark(index: Int): Long = marks[index]

    fun setMark(index: Int, mark: Long) {
        marks[index] = mark
    }

    /**
     * Adds or updates the link from [from]. Returns whether it is new; a new link collects the sender's last export.
     *
     * @param hint see [indexOf].
     */
    fun put(from: Node, length: Float, attenuation: Float, tick: Long, hint: Int, transmitter: Transmitter): Boolean {
        val found = indexOf(from.id, hint)
        val index = if (found >= 0) found else -found - 1
        if (found < 0) insertLink(index, from, tick)
        lengths[index] = length
        attenuations[index] = attenuation
        if (found < 0 && channels != null) collect(index, transmitter)
        return found < 0
    }

    fun removeLink(from: Node) {
        val index = indexOf(from.id)
        lengths.copyInto(lengths, index, index + 1, size)
        attenuations.copyInto(attenuations, index, index + 1, size)
        since.copyInto(since, index, index + 1, size)
        marks.copyInto(marks, index, index + 1, size)
        channels?.let {
            channel(index).close()
            it.copyInto(it, index, index + 1, size)
            it[size - 1] = null
        }
        removeAt(index)
        boxedIds = null
    }

    override fun resize(capacity: Int) {
        super.resize(capacity)
        lengths = lengths.copyOf(capacity)
        attenuations = attenuations.copyOf(capacity)
        since = since.copyOf(capacity)
        marks = marks.copyOf(capacity)
        channels = channels?.copyOf(capacity)
    }

    private fun insertLink(index: Int, from: Node, tick: Long) {
        insertAt(index, from)
        lengths.copyInto(lengths, index + 1, index, size - 1)
        attenuations.copyInto(attenuations, index + 1, index, size - 1)
        since.copyInto(since, index + 1, index, size - 1)
        marks.copyInto(marks, index + 1, index, size - 1)
        channels?.let {
            it.copyInto(it, index + 1, index, size - 1)
            it[index] = Channel()
        }
        since[index] = tick
        marks[index] = 0
        boxedIds = null
    }

    private companion object {
        val NONE = emptyArray<Any>()
    }
}
