package org.collektive.engine

/** What the rounds of one tick gave; belongs to the engine and changes with the next tick. */
public class TickResult internal constructor() {
    private var nodes = arrayOfNulls<Node>(0)
    private var answers = arrayOfNulls<Any?>(0)
    private var failures = arrayOfNulls<String>(0)

    /** How many nodes were due. */
    public var size: Int = 0
        private set

    /** Nanoseconds that the rounds took. */
    public var roundNanos: Long = 0
        internal set

    /** How many rounds failed. */
    public var failureCount: Int = 0
        private set

    /** What the network did. */
    public val network: NetworkCounts = NetworkCounts()

    /** Id of the due node [index]. */
    public fun id(index: Int): Int = node(index).id

    /** Program of the due node [index]. */
    public fun program(index: Int): NodeProgram = node(index).program

    /** What the round of the due node [index] returned; `null` when it failed. */
    public fun answer(index: Int): Any? = answers[index]

    /** Why the round of the due node [index] failed; `null` when it did not. */
    public fun failure(index: Int): String? = failures[index]

    internal fun node(index: Int): Node = nodes[index] ?: error("no due node $index of $size")

    internal fun reset(count: Int) {
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
