package org.collektive.engine

/** A list of nodes in ascending order of their ids. */
internal open class NodeList {
    var keys = IntArray(INITIAL_CAPACITY)
        private set
    var nodes = arrayOfNulls<Node>(INITIAL_CAPACITY)
        private set
    var size = 0
        private set

    /** Returns the index of the node [id], or `-(insertion index) - 1` if it is not in the list. */
    fun indexOf(id: Int): Int {
        // Nodes are often added in ascending order.
        if (size == 0 || keys[size - 1] < id) return -size - 1
        // Ids are often consecutive; then the index is the difference from the first id.
        val guess = id - keys[0]
        if (guess in 0 until size && keys[guess] == id) return guess
        return keys.binarySearch(id, 0, size)
    }

    /** Returns the same as [indexOf], in constant time if [hint], an earlier result, is still correct. */
    fun indexOf(id: Int, hint: Int): Int {
        val at = if (hint < 0) -hint - 1 else hint
        val isValid = if (hint < 0) {
            at <= size && (at == 0 || keys[at - 1] < id) && (at == size || keys[at] > id)
        } else {
            at < size && keys[at] == id
        }
        return if (isValid) hint else indexOf(id)
    }

    fun node(index: Int): Node = nodes[index] ?: error("no node at index $index; the list has $size nodes")

    fun find(id: Int): Node? {
        val index = indexOf(id)
        return if (index < 0) null else nodes[index]
    }

    /** Inserts [node], which must not be in the list. */
    fun insert(node: Node) = insertAt(-indexOf(node.id) - 1, node)

    /** Inserts [node] at [index], which must keep the order. */
    protected fun insertAt(index: Int, node: Node) {
        reserve(size + 1)
        keys.copyInto(keys, index + 1, index, size)
        nodes.copyInto(nodes, index + 1, index, size)
        keys[index] = node.id
        nodes[index] = node
        size++
    }

    fun removeAt(index: Int) {
        keys.copyInto(keys, index, index + 1, size)
        nodes.copyInto(nodes, index, index + 1, size)
        nodes[--size] = null
    }

    fun remove(node: Node) = removeAt(indexOf(node.id))

    /** Inserts all nodes of [sorted] in one pass. They must be in ascending order of their ids, and not in the list. */
    fun insertAll(sorted: List<Node>) {
        reserve(size + sorted.size)
        var old = size - 1
        var new = sorted.size - 1
        size += sorted.size
        for (target in size - 1 downTo 0) {
            if (new < 0) return
            val node = if (old >= 0 && keys[old] > sorted[new].id) nodes[old--] else sorted[new--]
            nodes[target] = node
            keys[target] = checkNotNull(node).id
        }
    }

    inline fun removeIf(isRemoved: (Node) -> Boolean) {
        var remaining = 0
        for (index in 0 until size) {
            val node = node(index)
            if (isRemoved(node)) continue
            nodes[remaining] = node
            keys[remaining++] = node.id
        }
        nodes.fill(null, remaining, size)
        size = remaining
    }

    protected open fun resize(capacity: Int) {
        keys = keys.copyOf(capacity)
        nodes = nodes.copyOf(capacity)
    }

    private fun reserve(required: Int) {
        if (required > keys.size) resize(maxOf(required, keys.size + (keys.size shr 1)))
    }

    private companion object {
        const val INITIAL_CAPACITY = 8
    }
}
