package org.collektive.engine

/**
 * Orders the rounds of a tick breadth first along the links, so that the rounds of neighbours run close together.
 *
 * A round reads the exports of its neighbours, and in this order most of them are still in the CPU cache. Garbage collectors also place
 * objects in the order in which they reach them. Results do not depend on the order.
 */
internal class RoundOrder {
    private var nodes = arrayOfNulls<Node>(0)
    private var size = 0
    private var turns = IntArray(0)

    // prefixEnds[i]: the rounds 0..i read only nodes[0 until prefixEnds[i]].
    private var prefixEnds = IntArray(0)

    /** Number of links added and removed since the last [arrange]. */
    private var linksChanged = 0

    /** Whether [turns] covers all nodes in their current order. */
    private var coversAllNodes = false

    fun linkChanged() {
        linksChanged++
    }

    /** Appends [added]; the next [arrange] puts them in order. */
    fun addAll(added: List<Node>) {
        if (nodes.size < size + added.size) nodes = nodes.copyOf(maxOf(size + added.size, size + (size shr 1)))
        for (node in added) nodes[size++] = node
        coversAllNodes = false
    }

    inline fun removeIf(isRemoved: (Node) -> Boolean) {
        var remaining = 0
        for (index in 0 until size) {
            val node = nodes[index]
            if (node != null && !isRemoved(node)) nodes[remaining++] = node
        }
        nodes.fill(null, remaining, size)
        size = remaining
        coversAllNodes = false
    }

    /** Reorders the nodes if enough of the [linkCount] links have changed; [all] contains the same nodes by id. */
    fun arrange(all: NodeList, linkCount: Int, tick: Long) {
        if (linksChanged * REORDER_DIVISOR <= linkCount + size) return
        linksChanged = 0
        coversAllNodes = false
        var placed = 0
        if (prefixEnds.size < nodes.size) prefixEnds = IntArray(nodes.size)
        for (index in 0 until all.size) {
            val start = all.node(index)
            if (start.orderedAt == tick) continue
            var next = placed
            placed = place(start, placed, tick)
            while (next < placed) {
                val receivers = checkNotNull(nodes[next++]).outgoing
                for (receiver in 0 until receivers.size) placed = place(receivers.node(receiver), placed, tick)
                prefixEnds[next - 1] = placed
            }
        }
    }

    /** Returns indices of the due nodes of [result] in the order of their rounds: the first `result.size` elements of the array. */
    fun turns(result: TickResult): IntArray {
        if (coversAllNodes && result.size == size) return turns
        if (turns.size < result.size) turns = IntArray(maxOf(result.size, turns.size + (turns.size shr 1)))
        for (index in 0 until size) nodes[index]?.dueIndex = -1
        for (index in 0 until result.size) result.node(index).dueIndex = index
        var turn = 0
        for (index in 0 until size) {
            val due = nodes[index]?.dueIndex ?: -1
            if (due >= 0) turns[turn++] = due
        }
        coversAllNodes = result.size == size
        return turns
    }

    /**
     * Prefetches the nodes that the rounds [begin] until [end] are the first to read.
     *
     * The reads of one round depend on each other, so their cache misses cannot overlap. Here the misses of many nodes overlap.
     *
     * @return a meaningless value that keeps the JIT from removing the reads.
     */
    fun prefetch(begin: Int, end: Int): Int {
        if (!coversAllNodes || end > prefixEnds.size) return 0
        var sum = 0
        for (index in (if (begin == 0) 0 else prefixEnds[begin - 1]) until prefixEnds[end - 1]) {
            val node = nodes[index] ?: continue
            sum += node.prefetchExports() + node.incoming.prefetch()
        }
        return sum
    }

    private fun place(node: Node, at: Int, tick: Long): Int {
        if (node.orderedAt == tick) return at
        node.orderedAt = tick
        nodes[at] = node
        return at + 1
    }

    private companion object {
        /**
         * Nodes are reordered once the changed links exceed this fraction of nodes and links. That happens at the start, but rarely while
         * a swarm moves.
         */
        const val REORDER_DIVISOR = 4
    }
}
