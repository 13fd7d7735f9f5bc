@file:OptIn(DelicateCollektiveApi::class)

package org.collektive.runtime

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi

/** What one round of a device left behind: per path the value kept and the value sent. */
internal class RoundRecord : Export() {
    private var paths = arrayOfNulls<PathNode>(INITIAL)
    private var kept = arrayOfNulls<Any?>(INITIAL)
    private var sent = arrayOfNulls<Any?>(INITIAL)
    private var count = 0

    fun clear() {
        if (count == 0) return
        paths.fill(null)
        kept.fill(null)
        sent.fill(null)
        count = 0
    }

    /** Takes [path] for a primitive; `false` when another one has it already. */
    fun claim(path: PathNode): Boolean {
        var index = slotOf(path)
        if (paths[index] === path) return false
        if (2 * (count + 1) > paths.size) {
            grow()
            index = slotOf(path)
        }
        paths[index] = path
        kept[index] = Nothing
        sent[index] = Nothing
        count++
        return true
    }

    fun keep(path: PathNode, value: Any?) {
        kept[slotOf(path)] = value
    }

    fun send(path: PathNode, value: Any?) {
        sent[slotOf(path)] = value
    }

    /** The value kept at [path], or [Nothing]. */
    fun keptAt(path: PathNode): Any? {
        val index = slotOf(path)
        return if (paths[index] === path) kept[index] else Nothing
    }

    /** The value sent at [path], or [Nothing]; a `Field` of an exchange stands for one value per receiver. */
    fun sentAt(path: PathNode): Any? {
        val index = slotOf(path)
        return if (paths[index] === path) sent[index] else Nothing
    }

    /** What the device [receiver] gets at [path], or [Nothing]; the default unless the sender knew it ([wasKnown]). */
    fun sentTo(receiver: Any, path: PathNode, wasKnown: Boolean): Any? {
        val value = sentAt(path)
        if (value !is Field<*, *>) return value
        @Suppress("UNCHECKED_CAST")
        val field = value as Field<Any, Any?>
        return if (wasKnown) field.getOrLocal(receiver) else field.local.value
    }

    /** At how many paths something was sent. */
    fun countSent(): Int = paths.indices.count { paths[it] != null && sent[it] !== Nothing }

    inline fun forEachPath(action: (PathNode) -> Unit) {
        for (path in paths) if (path != null) action(path)
    }

    /** Where [path] is, or the free slot where it would go. */
    private fun slotOf(path: PathNode): Int {
        val mask = paths.size - 1
        var index = path.hash and mask
        while (true) {
            val found = paths[index]
            if (found === path || found == null) return index
            index = index + 1 and mask
        }
    }

    private fun grow() {
        val oldPaths = paths
        val oldKept = kept
        val oldSent = sent
        paths = arrayOfNulls(2 * oldPaths.size)
        kept = arrayOfNulls(paths.size)
        sent = arrayOfNulls(paths.size)
        for (old in oldPaths.indices) {
            val path = oldPaths[old] ?: continue
            val index = slotOf(path)
            paths[index] = path
            kept[index] = oldKept[old]
            sent[index] = oldSent[old]
        }
    }

    /** Absence: `null` is a value. */
    object Nothing

    private companion object {
        const val INITIAL = 8
    }
}
