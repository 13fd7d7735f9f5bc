package org.collektive.engine

/**
 * Validates a whole tick against the current nodes and links, without changing them.
 *
 * Removed and updated objects are marked with the number of the validation, so the marks of a rejected tick do not affect the next one.
 */
internal class TickValidator(private val nodes: NodeList) {
    private var validation = 0L
    private val removed get() = 2 * validation
    private val updated get() = 2 * validation + 1

    private var addedIds = IntArray(0)
    private var addedCount = 0
    private var newLinks = LongArray(0)
    private var newLinkCount = 0
    private var places = IntArray(0)

    /** Returns the position of link [index] of the last tick among its receiver's incoming links: a hint for [NodeList.indexOf]. */
    fun place(index: Int): Int = places[index]

    /**
     * Validates [tick].
     *
     * @throws InvalidTickException at the first error.
     */
    fun check(tick: Tick, expectedNumber: Long) {
        validation++
        checkTime(tick, expectedNumber)
        checkNodesRemoved(tick)
        checkNodesAdded(tick)
        for (index in tick.nodesChanged.indices) {
            val id = tick.nodesChanged[index].id
            remaining(id) ?: reject(tick, "node $id cannot be changed: unknown node")
        }
        checkLinksRemoved(tick)
        checkLinks(tick)
        checkDue(tick)
    }

    /** Returns whether the last validated tick removes [node]. */
    fun removes(node: Node): Boolean = node.mark == removed

    private fun checkTime(tick: Tick, expectedNumber: Long) {
        if (tick.number != expectedNumber) reject(tick, "expected tick $expectedNumber")
        if (!tick.time.isFinite()) reject(tick, "the time is ${tick.time}; it must be finite")
        if (!(tick.deltaTime >= 0.0) || tick.deltaTime.isInfinite()) {
            reject(tick, "the delta time is ${tick.deltaTime}; it must be finite and 0 or greater")
        }
    }

    private fun checkNodesRemoved(tick: Tick) {
        for (index in 0 until tick.nodesRemoved.size) {
            val id = tick.nodesRemoved[index]
            val node = nodes.find(id) ?: reject(tick, "node $id cannot be removed: unknown node")
            if (removes(node)) reject(tick, "node $id is removed twice")
            node.mark = removed
        }
    }

    private fun checkNodesAdded(tick: Tick) {
        addedCount = tick.nodesAdded.size
        if (addedIds.size < addedCount) addedIds = IntArray(2 * addedCount)
        for (index in 0 until addedCount) {
            val id = tick.nodesAdded[index].id
            if (id < 0) reject(tick, "node $id cannot be added: the id must be 0 or greater")
            val existing = nodes.find(id)
            if (existing != null && !removes(existing)) reject(tick, "node $id cannot be added: the id is already in use")
            addedIds[index] = id
        }
        addedIds.sort(0, addedCount)
        for (index in 1 until addedCount) {
            if (addedIds[index - 1] == addedIds[index]) reject(tick, "node ${addedIds[index]} is added twice")
        }
    }

    private fun checkLinksRemoved(tick: Tick) {
        val list = tick.linksRemoved
        for (index in 0 until list.size / 2) {
            val from = list[2 * index]
            val to = list[2 * index + 1]
            val links = remaining(to)?.incoming
            val link = if (links == null || remaining(from) == null) -1 else links.indexOf(from)
            if (links == null || link < 0) reject(tick, "link $from -> $to cannot be removed: unknown link")
            if (links.mark(link) == removed) reject(tick, "link $from -> $to is removed twice")
            links.setMark(link, removed)
        }
    }

    private fun checkLinks(tick: Tick) {
        val list = tick.links
        if (newLinks.size < list.size) {
            newLinks = LongArray(2 * list.size)
            places = IntArray(2 * list.size)
        }
        newLinkCount = 0
        for (index in 0 until list.size) {
            places[index] = checkLink(tick, list.from(index), list.to(index), list.length(index), list.attenuation(index))
        }
        newLinks.sort(0, newLinkCount)
        for (index in 1 until newLinkCount) {
            val key = newLinks[index]
            if (newLinks[index - 1] == key) reject(tick, "link ${(key ushr 32).toInt()} -> ${key.toInt()} is added twice")
        }
    }

    private fun checkLink(tick: Tick, from: Int, to: Int, length: Float, attenuation: Float): Int {
        if (from == to) reject(tick, "node $from cannot be linked to itself")
        val sender = remaining(from)
        val receiver = remaining(to)
        if (sender == null && !isAdded(from)) reject(tick, "link $from -> $to: unknown node $from")
        if (receiver == null && !isAdded(to)) reject(tick, "link $from -> $to: unknown node $to")
        if (!(length >= 0f) || length.isInfinite()) {
            reject(tick, "link $from -> $to has length $length; it must be finite and 0 or greater")
        }
        if (!(attenuation >= 0f) || attenuation.isInfinite()) {
            reject(tick, "link $from -> $to has attenuation $attenuation; it must be finite and 0 or greater")
        }
        val links = if (sender == null) null else receiver?.incoming
        val existing = links?.indexOf(from) ?: -1
        if (links == null || existing < 0 || links.mark(existing) == removed) {
            newLinks[newLinkCount++] = from.toLong() shl 32 or to.toLong()
        } else {
            if (links.mark(existing) == updated) reject(tick, "link $from -> $to is updated twice")
            links.setMark(existing, updated)
        }
        return existing
    }

    private fun checkDue(tick: Tick) {
        val anyRemoved = tick.nodesRemoved.size > 0
        var last = -1
        var at = 0
        for (index in 0 until tick.due.size) {
            val id = tick.due[index]
            if (id <= last) reject(tick, "due node $id comes after $last; due ids must be in ascending order without duplicates")
            last = id
            // Both lists are ascending, so one pass over the keys finds all due nodes without a cache miss per node.
            while (at < nodes.size && nodes.keys[at] < id) at++
            val isPresent = at < nodes.size && nodes.keys[at] == id && !(anyRemoved && removes(nodes.node(at)))
            if (!isPresent && !isAdded(id)) reject(tick, "due node $id: unknown node")
        }
    }

    private fun remaining(id: Int): Node? = nodes.find(id)?.takeUnless(::removes)

    private fun isAdded(id: Int) = addedIds.binarySearch(id, 0, addedCount) >= 0

    private fun reject(tick: Tick, message: String): Nothing = throw InvalidTickException(tick.number, message)
}
