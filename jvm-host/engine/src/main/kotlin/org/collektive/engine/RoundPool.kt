package org.collektive.engine

import java.util.concurrent.atomic.AtomicInteger
import java.util.concurrent.locks.LockSupport

/**
 * The threads of one session. [run] is called by one thread; it allocates nothing.
 *
 * Work is handed out in ranges of indices; who gets which depends on timing, so a task must give the same result in any order.
 */
internal class RoundPool(private val size: Int) {
    /** What the threads do: all of `begin until end`, on the thread [worker]. */
    fun interface Task {
        fun run(thread: RoundThread, worker: Int, begin: Int, end: Int)
    }

    private val workers = Array(size) { Worker(it) }
    private val nextRange = AtomicInteger()
    private val busy = AtomicInteger()
    private var task = Task { _, _, _, _ -> }
    private var count = 0
    private var range = 1

    // What a task threw: an error of ours, since rounds keep theirs.
    @Volatile
    private var failure: Throwable? = null

    @Volatile
    private var caller: Thread? = null

    @Volatile
    var isClosed = false
        private set

    init {
        for (worker in workers) worker.thread.start()
    }

    /**
     * Runs [task] over `0 until count` in ranges of [range] and waits for the end; `false` when `System.nanoTime()` passed [deadline]
     * first: then the pool is of no use any more, and must be abandoned.
     */
    fun run(task: Task, count: Int, range: Int, deadline: Long): Boolean {
        if (count == 0) return true
        this.task = task
        this.count = count
        this.range = range
        nextRange.set(0)
        caller = Thread.currentThread()
        val needed = minOf(size, (count + range - 1) / range)
        busy.set(needed)
        for (index in 0 until needed) workers[index].start()
        while (busy.get() > 0) {
            val left = deadline - System.nanoTime()
            if (left <= 0) return false
            LockSupport.parkNanos(this, left)
        }
        failure?.let { throw IllegalStateException("a thread of the engine failed", it) }
        return true
    }

    /** Ends all idle threads now and busy ones at the end of the round they are in; interrupts those. */
    fun abandon() {
        isClosed = true
        for (worker in workers) worker.thread.interrupt()
    }

    /** What each thread is doing, for the log. */
    fun dump(): String = buildString {
        for (worker in workers) {
            val thread = worker.thread
            append('"').append(thread.name).append("\" ").append(thread.state)
            if (thread.node >= 0) append(", in the round of node ").append(thread.node)
            append('\n')
            for (frame in thread.stackTrace) append("    at ").append(frame).append('\n')
        }
    }

    private fun work(worker: Worker) {
        while (!isClosed) {
            val begin = nextRange.getAndAdd(range)
            if (begin >= count) return
            task.run(worker.thread, worker.index, begin, minOf(begin + range, count))
        }
    }

    private inner class Worker(val index: Int) : Runnable {
        val thread = RoundThread("collektive-round-$index", this)

        @Volatile
        private var isWanted = false

        fun start() {
            isWanted = true
            LockSupport.unpark(thread)
        }

        override fun run() {
            while (!isClosed) {
                if (!isWanted) {
                    LockSupport.park(this@RoundPool)
                    continue
                }
                isWanted = false
                try {
                    work(this)
                } catch (e: Throwable) {
                    failure = e
                }
                // A program may have left its thread interrupted, and park() would not wait any more.
                Thread.interrupted()
                if (busy.decrementAndGet() == 0) LockSupport.unpark(caller)
            }
        }
    }
}
