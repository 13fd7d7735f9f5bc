package org.collektive.engine

import java.util.concurrent.atomic.AtomicIntegerFieldUpdater

/** A thread that runs rounds of programs. Unbounded recursion overflows its stack and fails only that round. */
public class RoundThread internal constructor(name: String, task: Runnable) : Thread(null, task, name, STACK_BYTES) {
    init {
        isDaemon = true
    }

    @Volatile
    private var running = -1

    /** Id of the node whose round runs on this thread, or -1. Other threads may read a stale value; a fence per round is too slow. */
    public val node: Int get() = running

    /** Number of rounds that have begun on this thread. */
    public var rounds: Long = 0
        private set

    /** Name of the program whose round is running or ran last. Read it only on this thread. */
    public var program: String = ""
        private set

    /** Sum of the results of [RoundOrder.prefetch], stored so that the JIT does not remove the reads. */
    internal var prefetched = 0

    /** Marks the start of the round of [next]. */
    internal fun begin(next: Node) {
        program = next.program.name
        RUNNING.lazySet(this, next.id)
        rounds++
    }

    /** Marks the end of the round. */
    internal fun end() = RUNNING.lazySet(this, -1)

    override fun run() {
        ThreadOrigin.set("")
        super.run()
    }

    public companion object {
        private const val STACK_BYTES = 4L shl 20
        private val RUNNING = AtomicIntegerFieldUpdater.newUpdater(RoundThread::class.java, "running")

        /** Returns a description of the round that runs on, or started, the calling thread, for the log; `null` for other threads. */
        public fun origin(): String? {
            val thread = Thread.currentThread()
            if (thread is RoundThread) return if (thread.node < 0) null else "node ${thread.node}, program ${thread.program}"
            return ThreadOrigin.get()?.takeIf(String::isNotEmpty)?.let { "thread ${thread.name} of $it" }
        }
    }

    /** The round that started a thread, directly or through other threads. */
    private object ThreadOrigin : InheritableThreadLocal<String?>() {
        override fun childValue(parentValue: String?): String? = if (Thread.currentThread() is RoundThread) origin() else parentValue
    }
}
