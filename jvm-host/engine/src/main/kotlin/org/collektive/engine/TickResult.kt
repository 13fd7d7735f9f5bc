package org.collektive.engine

import org.collektive.spi.Export
import org.collektive.spi.StoredValues

/** The outcome of one tick. The engine owns it and reuses it for the next tick. */
public class TickResult internal constructor() {
    private var nodes = arrayOfNulls<Node>(0)
    private var answers = arrayOfNulls<Any?>(0)
    private var failures = arrayOfNulls<String>(0)

    /** Number of the tick. */
    public var tick: Long = 0
        private set

    /** Number of nodes after the tick's changes. */
    public var nodeCount: Int = 0
        internal set

    /** Number of directed links after the tick's changes. */
    public var linkCount: Int = 0
        internal set

    /** Number of due nodes. */
    public var size: Int = 0
        private set

    /** Duration of all rounds and of message delivery, in nanoseconds. */
    public var roundNanos: Long = 0
        internal set

    /** Number of rounds that failed. */
    public var failureCount: Int = 0
        private set

    /** Values that the tick's reload found and kept; `null` without a reload. */
    public var storedValues: StoredValues? = null
        internal set

    /** Counts of messages. */
    public val network: NetworkCounts = NetworkCounts()

    /** Returns the id of the due node [index]. */
    public fun id(index: Int): Int = node(index).id

    /** Returns the program of the due node [index]. */
    public fun program(index: Int): NodeProgram = node(index).program

    /** Returns the answer of the due node [index], or `null` if its round failed. */
    public fun answer(index: Int): Any? = answers[index]

    /** Returns why the round of the due node [index] failed, or `null` on success. */
    public fun failure(index: Int): String? = failures[index]

    /** Returns the last message of the due node [index], or `null` before its first successful round. */
    public fun export(index: Int): Export? = node(index).last

    internal fun node(index: Int): Node = nodes[index] ?: error("no due node $index of $size")

    internal fun reset(tick: Long, count: Int) {
        this.tick = tick
        answers.fill(null, 0, size)
        failures.fill(null, 0, size)
        if (nodes.size < count) {
            val capacity = maxOf(count, nodes.size + (nodes.size shr 1))
            nodes = arrayOfNulls(capacity)
            answers = arrayOfNulls(capacity)
            failures = arrayOfNulls(capacity)
        }
        nodes.fill(null, count, maxOf(count, minOf(size, nodes.size)))
        size = count
        failureCount = 0
        roundNanos = 0
        storedValues = null
        network.clear()
    }

    internal fun countFailures() {
        for (index in 0 until size) if (failures[index] != null) failureCount++
    }

    internal fun due(index: Int, node: Node) {
        nodes[index] = node
    }

    internal fun answered(index: Int, answer: Any) {
        answers[index] = answer
    }

    internal fun failed(index: Int, failure: String) {
        failures[index] = failure
    }
}
