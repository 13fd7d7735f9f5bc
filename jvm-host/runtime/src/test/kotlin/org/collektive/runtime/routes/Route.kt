package org.collektive.runtime.routes

import it.unibo.collektive.aggregate.api.Aggregate

/** One way of running the same devices on the same [Graph]. */
internal interface Route {
    val name: String

    /** Makes a device without state. */
    fun add(id: Int)

    fun remove(id: Int)

    /** Runs one round of each device in [due]; returns what each returned or threw. Successful rounds send their messages at the end. */
    fun round(graph: Graph, due: List<Int>, program: Aggregate<Int>.() -> Any?): Map<Int, Result<Any?>>
}

/** Directed links with the time at which they were added, and the time at which each device last sent. */
internal class Graph {
    var now = 0
    val ids = sortedSetOf<Int>()
    private val links = HashMap<Int, java.util.TreeMap<Int, Int>>()
    private val sentAt = HashMap<Int, Int>()

    fun add(id: Int) {
        ids += id
        links[id] = java.util.TreeMap()
    }

    fun remove(id: Int) {
        ids -= id
        links.remove(id)
        sentAt.remove(id)
        links.values.forEach { it.remove(id) }
    }

    fun link(from: Int, to: Int) {
        links.getValue(to).putIfAbsent(from, now)
    }

    fun cut(from: Int, to: Int) {
        links.getValue(to).remove(from)
    }

    fun sent(ids: Collection<Int>) {
        for (id in ids) sentAt[id] = now
    }

    /** The senders of links to [id], ascending. */
    fun senders(id: Int): List<Int> = links.getValue(id).keys.toList()

    /** Whether the link existed when [from] sent. */
    fun wasKnown(from: Int, to: Int): Boolean = links.getValue(to).getValue(from) < (sentAt[from] ?: -1)
}
