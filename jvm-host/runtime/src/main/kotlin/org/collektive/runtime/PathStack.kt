package org.collektive.runtime

import org.collektive.alignment.RunningDevice

/**
 * The alignment stack of a thread, which all rounds on the thread reuse. A single stack stays in the core's L1 cache, but one stack per
 * device would not.
 */
internal class PathStack(private val tree: PathTree) {
    /** The thread that created this stack, the only one that may use it. */
    val thread: Thread = Thread.currentThread()

    /** Holds the device whose round runs on the thread. */
    val running: RunningDevice = RunningDevice.ofThread()

    // tokens[0 until depth] is the stack. nodes[0..resolved] are the paths of its first prefixes. Paths are looked up only when a
    // primitive runs, so a pivot without primitives costs no look-up.
    private var tokens = arrayOfNulls<Any?>(INITIAL_DEPTH)
    private var nodes = arrayOfNulls<PathNode>(INITIAL_DEPTH + 1).also { it[0] = tree.root }
    var depth = 0
        private set
    private var resolved = 0

    // The stack depths at which ids of entries were pushed, ascending.
    private var entries = IntArray(2)
    private var entryCount = 0

    // The stack depths at which regions began, ascending, and the regions.
    private var regionDepths = IntArray(INITIAL_DEPTH)
    private var regions = IntArray(INITIAL_DEPTH)
    private var regionCount = 0

    /** The last region that began. Each device continues with its own number, because its stored fields refer to earlier regions. */
    var lastRegion = 0

    /** The innermost region, or 0. */
    val region get() = regions[regionCount]

    fun push(token: Any?) {
        if (depth == tokens.size) {
            tokens = tokens.copyOf(2 * depth)
            nodes = nodes.copyOf(2 * depth + 1)
        }
        tokens[depth++] = token
    }

    /** Marks the last token as the id of an entry. */
    fun markEntry() {
        if (entryCount == entries.size) entries = entries.copyOf(2 * entryCount)
        entries[entryCount++] = depth
    }

    /** Begins a region, which ends when the last token is popped. */
    fun beginRegion() {
        if (++regionCount == regions.size) {
            regionDepths = regionDepths.copyOf(2 * regionCount)
            regions = regions.copyOf(2 * regionCount)
        }
        if (++lastRegion == 0) lastRegion = 1
        regionDepths[regionCount] = depth
        regions[regionCount] = lastRegion
    }

    /** Pops tokens until the depth is [depth], and clears their references for the garbage collector. */
    fun popTo(depth: Int) {
        while (this.depth > depth) tokens[--this.depth] = null
        while (resolved > depth) nodes[resolved--] = null
        while (entryCount > 0 && entries[entryCount - 1] > depth) entryCount--
        while (regionDepths[regionCount] > depth) regionCount--
    }

    /** Returns a copy of the tokens on the stack. */
    fun tokens(): List<Any?> = tokens.copyOf(depth).asList()

    /** Returns the tokens whose paths have been looked up. */
    fun resolvedTokens(): List<Any?> = tokens().subList(0, resolved)

    /** Returns the path of the whole stack, which [device] creates if it is new. */
    fun path(device: AggregateDevice<*>): PathNode {
        var node = checkNotNull(nodes[resolved])
        while (resolved < depth) {
            node = tree.find(node, tokens[resolved]) ?: device.enter(node, tokens[resolved])
            nodes[++resolved] = node
        }
        return node
    }

    /** Returns the path of the stack without ids of entries. */
    fun projectionPath(device: AggregateDevice<*>): PathNode {
        if (entryCount == 0) return path(device)
        var node = tree.root
        var entry = 0
        for (index in 0 until depth) {
            if (entry < entryCount && entries[entry] == index + 1) {
                entry++
            } else {
                node = tree.find(node, tokens[index]) ?: device.enter(node, tokens[index])
            }
        }
        return node
    }

    private companion object {
        const val INITIAL_DEPTH = 16
    }
}
