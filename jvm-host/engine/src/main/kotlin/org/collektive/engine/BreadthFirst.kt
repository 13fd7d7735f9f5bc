package org.collektive.engine

/**
 * The order in which rounds run: breadth first along the links, so that neighbours run close together.
 *
 * A round reads its neighbours' exports; in this order, most of them are still in the CPU cache. Garbage collectors also place objects
 * in the order in which they reach them. Results do not depend on this order.
 */
internal class BreadthFirst {
    private var nodes = arrayOfNulls<Node>(0)
    private var size = 0
    private var turns = IntArray(0)

    // reached[i]: end of the prefix of `nodes` that rounds 0..i read.
    private var reached = IntArray(0)

    /** Number of links added and removed since the last [arrange]. */
    private var linksChanged = 0

    /** Whether [turns] contains all nodes in their current order. */
    private var isForAll = false

    fun linkChanged() {
        linksChanged++
    }

    /** Appends [added]; the next [arrange] puts them in order. */
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

    /** Reorders the nodes if enough of the [linkCount] links have changed; [all] contains the same nodes by id. */
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

    /** Indices into the due nodes of [result], in this order; the first `result.size` elements. */
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
     * Prefetches the nodes that the rounds [begin] until [end] are the first to read. A round's own reads depend on each other and would
     * wait one by one; here the misses of many nodes overlap.
     *
     * @return a meaningless value, which keeps the JIT from removing the reads.
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
        /** Reorder once a quarter of the links has changed: always at the start, rarely while a swarm moves. */
        const val CHANGES_WORTH_IT = 4
    }
}
