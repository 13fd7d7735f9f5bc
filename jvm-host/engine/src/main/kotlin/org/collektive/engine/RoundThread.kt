package org.collektive.engine

import java.util.concurrent.atomic.AtomicIntegerFieldUpdater

/** A thread that runs users' rounds. It has a stack of its own: endless recursion ends in an error and harms nothing else. */
public class RoundThread internal constructor(name: String, task: Runnable) : Thread(null, task, name, STACK_BYTES) {
    init {
        isDaemon = true
    }

    @Volatile
    private var running = -1

    /** Id of the node whose round runs here, or -1. Other threads may see it late: a round does not pay for a full fence. */
    public val node: Int get() = running

    /** Number of rounds begun on this thread. */
    public var rounds: Long = 0
        private set

    /** Name of the program of that round; on this thread only. */
    public var program: String = ""
        private set

    /** Sum of what [BreadthFirst.touch] read, kept so that the JIT does not drop the reads. */
    internal var touched = 0

    /** The round of [next] begins here. */
    internal fun begin(next: Node) {
        program = next.program.name
        RUNNING.lazySet(this, next.id)
        rounds++
    }

    /** The round is over. */
    internal fun end() = RUNNING.lazySet(this, -1)

    override fun run() {
        MakerOfThread.set("")
        super.run()
    }

    public companion object {
        private const val STACK_BYTES = 4L shl 20
        private val RUNNING = AtomicIntegerFieldUpdater.newUpdater(RoundThread::class.java, "running")

        /** Whose code runs on the calling thread, for the log: a round's, or that of a thread which a round made; else `null`. */
        public fun origin(): String? {
            val thread = Thread.currentThread()
            if (thread is RoundThread) return if (thread.node < 0) null else "node ${thread.node}, program ${thread.program}"
            return MakerOfThread.get()?.takeIf(String::isNotEmpty)?.let { "thread ${thread.name} of $it" }
        }
    }

    /** Passed on from thread to thread: the round in which the first of them was made. */
    private object MakerOfThread : InheritableThreadLocal<String?>() {
        override fun childValue(parentValue: String?): String? = if (Thread.currentThread() is RoundThread) origin() else parentValue
    }
}
