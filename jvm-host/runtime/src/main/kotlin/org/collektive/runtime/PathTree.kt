package org.collektive.runtime

import it.unibo.collektive.path.FullPath
import org.collektive.alignment.location
import org.collektive.alignment.readable

/**
 * All paths of a session. Equal paths are the same object on all devices.
 *
 * Look-ups take no lock. A new node is added under the tree's lock, to its parent's table in place or to a larger copy; a reader that
 * misses it looks again under the lock. The write into the table is a benign data race: a reader finds the node with its final fields
 * initialised (Java Language Specification, 17.5).
 */
internal class PathTree {
    val root = PathNode(null, null)

    private var size = 0
    private var sweepThreshold = FIRST_SWEEP
    private var sweep = 0

    /** Returns the child of [parent] for [token], or `null` if it does not exist or another thread has just added it. Thread-safe. */
    fun find(parent: PathNode, token: Any?): PathNode? = parent.children?.find(token)

    /** Returns the child of [parent] for [token], and creates it if necessary. Thread-safe. */
    @Synchronized
    fun enter(parent: PathNode, token: Any?): PathNode {
        val children = parent.children ?: PathTable.of(0)
        children.find(token)?.let { return it }
        val node = PathNode(parent, token)
        parent.children = children.with(node)
        size++
        return node
    }

    /** Whether the tree has grown so much since the last [keepOnly] that another call is worthwhile. */
    val needsSweep: Boolean get() = size > sweepThreshold

    /**
     * Keeps the paths that [visit] passes to its argument, and their ancestors, and removes all others. Call it only while no round
     * runs.
     */
    fun keepOnly(visit: ((PathNode) -> Unit) -> Unit) {
        sweep++
        visit(::mark)
        size = 0
        val open = ArrayDeque(listOf(root))
        while (open.isNotEmpty()) {
            val node = open.removeLast()
            val remainingChildren = node.children?.filtered { it.sweep == sweep }
            node.children = remainingChildren
            remainingChildren?.forEach {
                size++
                open.addLast(it)
            }
        }
        sweepThreshold = maxOf(FIRST_SWEEP, 2 * size)
    }

    private fun mark(node: PathNode) {
        var current: PathNode? = node
        while (current != null && current.sweep != sweep) {
            current.sweep = sweep
            current = current.parent
        }
    }

    private companion object {
        /** Minimum size for a sweep. Programs with constant pivots have far fewer paths. */
        const val FIRST_SWEEP = 4096
    }
}

/** A path that consists of the tokens of [parent], followed by [token]. */
internal class PathNode(val parent: PathNode?, val token: Any?) {
    private val tokenHash = token.hashCode()

    /** The hash, with well-mixed low bits, because tables use those. */
    val hash: Int = ((parent?.hash ?: 0) * 31 + tokenHash).let { it * -0x61c88647 xor (it ushr 15) }

    /** The children, or `null`. A racing reader may see `null`, too. Written under the tree's lock. */
    @Volatile
    var children: PathTable? = null

    /** Number of the last sweep that marked this node. Accessed only while no round runs. */
    var sweep = 0

    fun matches(other: Any?, hash: Int) = token === other || tokenHash == hash && token == other

    fun slot(mask: Int) = spread(tokenHash) and mask

    override fun toString(): String = FullPath(tokens()).toString()

    /** Returns the text of the path with the source location of each call, which distinguishes calls of the same function. */
    fun withLocations(): String = tokens().joinToString(" > ") { token -> readable(token) + location(token)?.let { " ($it)" }.orEmpty() }

    // The root has no token.
    private fun tokens() = generateSequence(this) { it.parent }.filter { it.parent != null }.map(PathNode::token).toList().asReversed()

    companion object {
        fun spread(hash: Int) = hash * -0x61c88647 ushr 7
    }
}

/** The children of a node by token: a hash table with open addressing, at most half full. */
internal class PathTable private constructor(private val slots: Array<PathNode?>, private var count: Int) {
    fun find(token: Any?): PathNode? {
        val hash = token.hashCode()
        val mask = slots.size - 1
        var index = PathNode.spread(hash) and mask
        while (true) {
            val node = slots[index] ?: return null
            if (node.matches(token, hash)) return node
            index = index + 1 and mask
        }
    }

    /** Adds [node]. Returns this table, or a larger copy if this table is full. */
    fun with(node: PathNode): PathTable {
        val table = if (2 * (count + 1) <= slots.size) this else resized(count + 1)
        table.put(node)
        return table
    }

    /** Returns a table of the nodes for which [keep] returns `true`, or `null` if it never does. */
    inline fun filtered(keep: (PathNode) -> Boolean): PathTable? {
        var remaining = 0
        forEach { if (keep(it)) remaining++ }
        if (remaining == 0) return null
        val table = of(remaining)
        forEach { if (keep(it)) table.put(it) }
        return table
    }

    inline fun forEach(action: (PathNode) -> Unit) {
        for (node in slots) if (node != null) action(node)
    }

    private fun resized(size: Int): PathTable {
        val table = of(size)
        forEach(table::put)
        return table
    }

    private fun put(node: PathNode) {
        val mask = slots.size - 1
        var index = node.slot(mask)
        while (slots[index] != null) index = index + 1 and mask
        slots[index] = node
        count++
    }

    companion object {
        /** An empty table with room for [size] nodes. */
        fun of(size: Int) = PathTable(arrayOfNulls(capacityFor(size)), 0)

        private fun capacityFor(size: Int) = maxOf(4, Integer.highestOneBit(2 * size - 1) shl 1)
    }
}
