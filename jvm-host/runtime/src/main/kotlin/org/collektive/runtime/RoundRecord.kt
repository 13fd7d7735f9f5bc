package org.collektive.runtime

/** What one round of a device left behind: per path the value kept and the value sent. */
internal class RoundRecord : Export() {
    // A hash table by identity, at most half full. A path, its kept and its sent value stand side by side: neighbours who read one of
    // them in a random place of the memory have all three in one cache line.
    private var slots = arrayOfNulls<Any?>(INITIAL)
    private var count = 0

    fun clear() {
        if (count == 0) return
        slots.fill(null)
        count = 0
    }

    /** Takes [path] for a primitive; `false` when another one has it already. */
    fun claim(path: PathNode): Boolean {
        var slot = slotOf(path)
        if (slots[slot] === path) return false
        if (2 * WIDTH * (count + 1) > slots.size) {
            grow()
            slot = slotOf(path)
        }
        slots[slot] = path
        slots[slot + KEPT] = Nothing
        slots[slot + SENT] = Nothing
        count++
        return true
    }

    fun keep(path: PathNode, value: Any?) {
        slots[slotOf(path) + KEPT] = value
    }

    /** A `Field` stands for one value per receiver. */
    fun send(path: PathNode, value: Any?) {
        slots[slotOf(path) + SENT] = value
    }

    /** At how many paths a value was sent. */
    fun countSent(): Int {
        var sent = 0
        for (slot in slots.indices step WIDTH) if (slots[slot] != null && slots[slot + SENT] !== Nothing) sent++
        return sent
    }

    /** The value kept at [path], or [Nothing]. */
    fun keptAt(path: PathNode): Any? = at(path, KEPT)

    /** The value sent at [path], or [Nothing]; a `Field` of an exchange stands for one value per receiver. */
    fun sentAt(path: PathNode): Any? = at(path, SENT)

    fun forEachPath(action: (PathNode) -> Unit) {
        for (slot in slots.indices step WIDTH) (slots[slot] as PathNode?)?.let(action)
    }

    private fun at(path: PathNode, offset: Int): Any? {
        val slots = slots
        var slot = firstSlot(path, slots)
        while (true) {
            val found = slots[slot]
            if (found === path) return slots[slot + offset]
            if (found == null) return Nothing
            slot = after(slot, slots)
        }
    }

    /** Where [path] is, or the free slot where it would go. */
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
        slots = arrayOfNulls(2 * old.size)
        for (from in old.indices step WIDTH) {
            val path = old[from] as PathNode? ?: continue
            old.copyInto(slots, slotOf(path), from, from + WIDTH)
        }
    }

    /** Absence: `null` is a value. */
    object Nothing

    private companion object {
        // A path and its values, and one place unused: powers of two need no division.
        const val WIDTH = 4
        const val KEPT = 1
        const val SENT = 2
        const val INITIAL = 2 * WIDTH
    }
}
