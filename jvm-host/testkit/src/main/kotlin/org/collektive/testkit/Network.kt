package org.collektive.testkit

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import java.util.TreeMap
import java.util.concurrent.Callable
import java.util.concurrent.ExecutorService
import java.util.concurrent.Executors

/**
 * Devices of [runtimes] in lockstep, without an engine. Tests change nodes and links between rounds.
 *
 * @param ids the first nodes.
 * @param isParallel whether the rounds of one step run on several threads.
 */
public open class Network(private val runtimes: DeviceRuntimes, vararg ids: Int, private val isParallel: Boolean = false) {
    private val nodes = TreeMap<Int, Node>()
    private var now = 0

    /** The ids of all nodes, ascending. */
    public val ids: Set<Int> get() = nodes.keys

    /** Number of nodes. */
    public val size: Int get() = nodes.size

    init {
        add(*ids)
    }

    /** Adds nodes without state and links. */
    public fun add(vararg ids: Int): Unit = ids.forEach { nodes[it] = Node(runtimes.device(it)) }

    /** Removes the node [id] with its links. */
    public fun remove(id: Int) {
        nodes.remove(id)
        nodes.values.forEach { it.links.remove(id) }
    }

    /** Links [a] and [b] in both directions, or changes the length of their link. */
    public fun link(a: Int, b: Int, length: Double = 1.0) {
        linkOneWay(a, b, length)
        linkOneWay(b, a, length)
    }

    /** Adds a link from [from] to [to], or changes its length. */
    public fun linkOneWay(from: Int, to: Int, length: Double = 1.0) {
        node(to).links.getOrPut(from) { Link(node(from), now) }.length = length
    }

    /** Removes the links between [a] and [b]. */
    public fun unlink(a: Int, b: Int) {
        unlinkOneWay(a, b)
        unlinkOneWay(b, a)
    }

    /** Removes the link from [from] to [to]. */
    public fun unlinkOneWay(from: Int, to: Int) {
        node(to).links.remove(from)
    }

    /** Links each pair of consecutive [ids]. */
    public fun line(vararg ids: Int): Network = apply { for ((a, b) in ids.toList().zipWithNext()) link(a, b) }

    /** Returns the senders of links to [id], ascending. */
    public fun neighbors(id: Int): Set<Int> = node(id).links.keys

    /** Returns the length of the link from [from] to [to]. */
    public fun length(from: Int, to: Int): Double = node(to).links.getValue(from).length

    /** Returns the device of the node [id]. */
    public fun device(id: Int): DeviceRuntime = node(id).device

    /** Runs one round of each node in [due] and returns the results or exceptions. Successful rounds send their messages at the end. */
    public fun <R> outcomes(due: Collection<Int> = ids, program: Aggregate<Int>.() -> R): Map<Int, Result<R>> {
        now++
        runtimes.freeUnused(nodes.values.map { it.device })
        val rounds = due.map { id -> Callable { runCatching { node(id).round(program) } } }
        val results = if (isParallel) POOL.invokeAll(rounds).map { it.get() } else rounds.map { it.call() }
        return due.zip(results).toMap().onEach { (id, result) -> if (result.isSuccess) node(id).send() }
    }

    /**
     * Runs one round of each node in [due] and returns the results.
     *
     * @throws Throwable the exception of the first failed round.
     */
    public fun <R> round(due: Collection<Int>, program: Aggregate<Int>.() -> R): Map<Int, R> =
        outcomes(due, program).mapValues { it.value.getOrThrow() }

    /** Runs one round of all nodes and returns the results. */
    public fun <R> round(program: Aggregate<Int>.() -> R): Map<Int, R> = round(ids, program)

    private fun node(id: Int): Node = nodes.getValue(id)

    /** A link that has existed since the time [since]. */
    private class Link(val sender: Node, val since: Int) {
        var length = 1.0
    }

    private inner class Node(val device: DeviceRuntime) : Inbox {
        val links = TreeMap<Int, Link>()
        private var export: Export? = null
        private var sentAt = 0

        override val size get() = links.size
        override val ids get() = links.keys.toTypedArray<Any>()
        override fun export(index: Int) = link(index).sender.export
        override fun wasKnown(index: Int) = link(index).let { it.since < it.sender.sentAt }

        private fun link(index: Int) = links.values.elementAt(index)

        @Suppress("UNCHECKED_CAST")
        fun <R> round(program: Aggregate<Int>.() -> R): R =
            device.round(this, { aggregate, _ -> (aggregate as Aggregate<Int>).program() }, null) as R

        fun send() {
            export = device.commit()
            sentAt = now
        }
    }

    private companion object {
        val POOL: ExecutorService = Executors.newFixedThreadPool(4) { Thread(it).apply { isDaemon = true } }
    }
}
