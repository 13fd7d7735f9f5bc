package org.collektive.engine

import org.collektive.runtime.Export
import org.collektive.runtime.Inbox

/** The links into one node, ascending by the sender's id, with their values. */
internal class IncomingLinks :
    Peers(),
    Inbox {
    private var lengths = FloatArray(keys.size)
    private var attenuations = FloatArray(keys.size)

    // Tick at which each link was made.
    private var since = LongArray(keys.size)

    // Last validation that touched each link: see TickValidator.
    private var marks = LongArray(keys.size)
    private var boxedIds: Array<Any>? = NONE

    override val ids: Array<Any>
        get() = boxedIds ?: Array<Any>(size) { node(it).boxedId }.also { boxedIds = it }

    override fun export(index: Int): Export? = node(index).export

    override fun wasKnown(index: Int): Boolean = since[index] <= node(index).sentAt

    fun mark(index: Int): Long = marks[index]

    fun setMark(index: Int, mark: Long) {
        marks[index] = mark
    }

    /** Makes the link, or gives it new values; `true` when it is new. [hint]: see [indexOf]. */
    fun put(from: Node, length: Float, attenuation: Float, tick: Long, hint: Int): Boolean {
        val found = indexOf(from.id, hint)
        val index = if (found >= 0) found else -found - 1
        if (found < 0) insertLink(index, from, tick)
        lengths[index] = length
        attenuations[index] = attenuation
        return found < 0
    }

    fun removeLink(from: Node) {
        val index = indexOf(from.id)
        lengths.copyInto(lengths, index, index + 1, size)
        attenuations.copyInto(attenuations, index, index + 1, size)
        since.copyInto(since, index, index + 1, size)
        marks.copyInto(marks, index, index + 1, size)
        removeAt(index)
        boxedIds = null
    }

    override fun resize(capacity: Int) {
        super.resize(capacity)
        lengths = lengths.copyOf(capacity)
        attenuations = attenuations.copyOf(capacity)
        since = since.copyOf(capacity)
        marks = marks.copyOf(capacity)
    }

    private fun insertLink(index: Int, from: Node, tick: Long) {
        insertAt(index, from)
        lengths.copyInto(lengths, index + 1, index, size - 1)
        attenuations.copyInto(attenuations, index + 1, index, size - 1)
        since.copyInto(since, index + 1, index, size - 1)
        marks.copyInto(marks, index + 1, index, size - 1)
        since[index] = tick
        marks[index] = 0
        boxedIds = null
    }

    private companion object {
        val NONE = emptyArray<Any>()
    }
}
