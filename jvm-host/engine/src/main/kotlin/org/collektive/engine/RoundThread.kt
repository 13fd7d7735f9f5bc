package org.collektive.engine

/** A thread that runs users' rounds: its stack is its own, so that endless recursion ends in an error and nothing else. */
public class RoundThread internal constructor(name: String, task: Runnable) : Thread(null, task, name, STACK_BYTES) {
    init {
        isDaemon = true
    }

    /** Id of the node whose round runs here, or -1. */
    @Volatile
    public var node: Int = -1
        internal set

    /** Rounds that this thread has begun. */
    public var rounds: Long = 0
        internal set

    private companion object {
        const val STACK_BYTES = 4L shl 20
    }
}
