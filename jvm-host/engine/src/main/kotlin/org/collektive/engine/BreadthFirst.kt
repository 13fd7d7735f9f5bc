package org.collektive.engine

/**
 * All nodes, so that neighbours stand near each other: breadth first along the links.
 *
 * Rounds run in this order. A round reads what its neighbours left in memory, and in this order most of it is still in the
 * processor's caches; collectors, too, lay out objects as they come upon them. No result depends on it.
 */
internal class BreadthFirst {
    private var nodes = arrayOfNulls<Node>(0)
    private var size = 0
    private var turns = IntArray(0)

    // How many nodes have been placed when each node's neighbours have: its round is the first to read those from here to the one before.
    private var reached = IntArray(0)

    /** Links made and ended since the nodes were put in order. */
    private var linksChanged = 0

    /** Whether [turns] are those of all nodes, in the present order. */
    private var isForAll = false

    fun linkChanged() {
        linksChanged++
    }

    /** Appends [added]; they find their places with the next [arrange]. */
    fun addAll(added: List<Node>) {
        if (nodes.size < size + added.size) nodes = nodes.copyOf(maxOf(size + added.size, size + (size shr 1)))
        for (node in added) nodes[size++] = node
        isForAll = false
    }

    inline fun removeIf(gone: (Node) -> Boolean) {
        var kept = 0
        for (index in 0 until size) {
            val node = nodes[index]
            if (node != null && !gone(node)) nodes[kept++] = node
        }
        nodes.fill(null, kept, size)
        size = kept
        isForAll = false
    }

    /** Puts the nodes in order when so many of the [linkCount] links are others that it pays; [all] are the same nodes by id. */
    fun arrange(all: Peers, linkCount: Int, tick: Long) {
        if (linksChanged * CHANGES_WORTH_IT <= linkCount + size) return
        linksChanged = 0
        isForAll = false
        var placed = 0
        if (reached.size < nodes.size) reached = IntArray(nodes.size)
        for (index in 0 until all.size) {
            val start = all.node(index)
            if (start.arrangedAt == tick) continue
            var next = placed
            placed = place(start, placed, tick)
            while (next < placed) {
                val receivers = checkNotNull(nodes[next++]).outgoing
                for (receiver in 0 until receivers.size) placed = place(receivers.node(receiver), placed, tick)
                reached[next - 1] = placed
            }
        }
    }

    /** The indices of the due nodes of [result] in this order, as many as [result] has. */
    fun turns(result: TickResult): IntArray {
        if (isForAll && result.size == size) return turns
        if (turns.size < result.size) turns = IntArray(maxOf(result.size, turns.size + (turns.size shr 1)))
        for (index in 0 until size) nodes[index]?.dueIndex = -1
        for (index in 0 until result.size) result.node(index).dueIndex = index
        var turn = 0
        for (index in 0 until size) {
            val due = nodes[index]?.dueIndex ?: -1
            if (due >= 0) turns[turn++] = due
        }
        isForAll = result.size == size
        return turns
    }

    /**
     * Reads the nodes that the rounds of these turns are the first to read, so that they are in the processor's caches by then. One after
     * the other, each would wait for several reads that depend on each other; here those of different nodes wait at the same time.
     */
    fun touch(begin: Int, end: Int): Int {
        if (!isForAll || end > reached.size) return 0
        var sum = 0
        for (index in (if (begin == 0) 0 else reached[begin - 1]) until reached[end - 1]) {
            val node = nodes[index] ?: continue
            sum += node.touchExports() + node.incoming.touch()
        }
        return sum
    }

    private fun place(node: Node, at: Int, tick: Long): Int {
        if (node.arrangedAt == tick) return at
        node.arrangedAt = tick
        nodes[at] = node
        return at + 1
    }

    private companion object {
        /** A fourth of the links must have changed: few orders when a swarm moves, and one at the start. */
        const val CHANGES_WORTH_IT = 4
    }
}
