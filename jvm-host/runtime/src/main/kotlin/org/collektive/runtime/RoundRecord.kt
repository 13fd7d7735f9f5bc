package org.collektive.runtime

import it.unibo.collektive.aggregate.Field
import org.collektive.spi.Export
import org.collektive.spi.MessageSize

/** The outcome of one round of a device, with the stored and the sent value at each path. */
internal class RoundRecord : Export() {
    // The first two paths are fields of the record; many programs have no more. Neighbours read records at random addresses, and fields
    // save them a second cache miss.
    private var path0: PathNode? = null
    private var stored0: Any? = null
    private var sent0: Any? = null
    private var path1: PathNode? = null
    private var stored1: Any? = null
    private var sent1: Any? = null

    // All other paths: a hash table by identity, at most half full. A path and its values are adjacent.
    private var slots = NONE
    private var count = 0

    // The type check loads the header of the value into the cache.
    override fun touch(): Int = if (sent0 is AllButOne || sent1 is AllButOne) 1 else 0

    fun clear() {
        path0 = null
        stored0 = null
        sent0 = null
        path1 = null
        stored1 = null
        sent1 = null
        if (count > 2) slots.fill(null)
        count = 0
    }

    /** Reserves [path] for a primitive. Returns `false` if it is already reserved. */
    fun reserve(path: PathNode): Boolean {
        if (path === path0 || path === path1) return false
        if (count == 0) {
            path0 = path
            stored0 = Nothing
            sent0 = Nothing
        } else if (count == 1) {
            path1 = path
            stored1 = Nothing
            sent1 = Nothing
        } else if (!reserveSlot(path)) {
            return false
        }
        count++
        return true
    }

    private fun reserveSlot(path: PathNode): Boolean {
        if (2 * WIDTH * (count - 1) > slots.size) grow()
        val slot = slotOf(path)
        if (slots[slot] === path) return false
        slots[slot] = path
        slots[slot + STORED] = Nothing
        slots[slot + SENT] = Nothing
        return true
    }

    fun store(path: PathNode, value: Any?) {
        if (path === path0) {
            stored0 = value
        } else if (path === path1) {
            stored1 = value
        } else {
            slots[slotOf(path) + STORED] = value
        }
    }

    /** Sends [value]; a `Field` or [AllButOne] contains a value for each receiver. */
    fun send(path: PathNode, value: Any?) {
        if (path === path0) {
            sent0 = value
        } else if (path === path1) {
            sent1 = value
        } else {
            slots[slotOf(path) + SENT] = value
        }
    }

    /** The number of paths at which a value was sent. */
    fun countSent(): Int {
        var sent = 0
        forEachPath { if (sentAt(it) !== Nothing) sent++ }
        return sent
    }

    /** The number of paths at which a value was stored. */
    fun countStored(): Int {
        var stored = 0
        forEachPath { if (storedAt(it) !== Nothing) stored++ }
        return stored
    }

    /** Replaces all paths and values with their results from [conversion]. */
    fun convert(conversion: ConvertedPaths) {
        val paths = ArrayList<PathNode>(count)
        forEachPath(paths::add)
        val stored = paths.map(::storedAt)
        val sent = paths.map(::sentAt)
        clear()
        for (index in paths.indices) {
            val path = conversion.path(paths[index]) ?: continue
            if (!reserve(path)) continue
            store(path, conversion.value(stored[index]))
            send(path, conversion.value(sent[index]))
        }
    }

    override fun measure(size: MessageSize) = forEachPath { path ->
        when (val sent = sentAt(path)) {
            Nothing -> {}

            is AllButOne -> {
                size.add(sent.others)
                if (sent.value != sent.others) size.addFor(sent.id, sent.value)
            }

            is Field<*, *> -> {
                size.add(sent.localValue)
                for (index in 0 until sent.neighborCount) {
                    if (sent.neighborValue(index) != sent.localValue) size.addFor(sent.neighborId(index), sent.neighborValue(index))
                }
            }

            else -> size.add(sent)
        }
    }

    /** Returns the value stored at [path], or [Nothing]. */
    fun storedAt(path: PathNode): Any? = if (path === path0) {
        stored0
    } else if (path === path1) {
        stored1
    } else {
        at(path, STORED)
    }

    /** Returns the value sent at [path], or [Nothing]. */
    fun sentAt(path: PathNode): Any? = if (path === path0) {
        sent0
    } else if (path === path1) {
        sent1
    } else {
        at(path, SENT)
    }

    fun forEachPath(action: (PathNode) -> Unit) {
        path0?.let(action)
        path1?.let(action)
        for (slot in slots.indices step WIDTH) (slots[slot] as PathNode?)?.let(action)
    }

    private fun at(path: PathNode, offset: Int): Any? {
        if (count <= 2) return Nothing
        val slots = slots
        var slot = firstSlot(path, slots)
        while (true) {
            val found = slots[slot]
            if (found === path) return slots[slot + offset]
            if (found == null) return Nothing
            slot = after(slot, slots)
        }
    }

    /** Returns the slot of [path], or the free slot for it. */
    private fun slotOf(path: PathNode): Int {
        val slots = slots
        var slot = firstSlot(path, slots)
        while (slots[slot] != null && slots[slot] !== path) slot = after(slot, slots)
        return slot
    }

    private fun firstSlot(path: PathNode, slots: Array<Any?>) = path.hash * WIDTH and slots.size - 1

    private fun after(slot: Int, slots: Array<Any?>) = slot + WIDTH and slots.size - 1

    private fun grow() {
        val old = slots
        slots = arrayOfNulls(if (old.size == 0) INITIAL else 2 * old.size)
        for (from in old.indices step WIDTH) {
            val path = old[from] as PathNode? ?: continue
            old.copyInto(slots, slotOf(path), from, from + WIDTH)
        }
    }

    /** Marks an absent value, since `null` is a value. */
    object Nothing

    private companion object {
        // A path, its two values and one unused element: a power of two, so that a mask replaces the division.
        const val WIDTH = 4
        const val STORED = 1
        const val SENT = 2
        const val INITIAL = 4 * WIDTH
        val NONE = arrayOfNulls<Any?>(0)
    }
}
