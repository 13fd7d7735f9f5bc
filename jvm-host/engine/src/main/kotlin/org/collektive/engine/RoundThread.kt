package org.collektive.engine

import java.util.concurrent.atomic.AtomicIntegerFieldUpdater

/** A thread that runs users' rounds: its stack is its own, so that endless recursion ends in an error and nothing else. */
public class RoundThread internal constructor(name: String, task: Runnable) : Thread(null, task, name, STACK_BYTES) {
    init {
        isDaemon = true
    }

    @Volatile
    private var running = -1

    /** Id of the node whose round runs here, or -1; other threads may see it late, since a round should not pay for that. */
    public var node: Int
        get() = running
        internal set(id) = RUNNING.lazySet(this, id)

    /** Rounds that this thread has begun. */
    public var rounds: Long = 0
        internal set

    /** Name of the program of that round; on this thread only. */
    public var program: String = ""
        internal set

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
