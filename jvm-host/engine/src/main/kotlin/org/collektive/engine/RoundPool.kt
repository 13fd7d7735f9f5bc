package org.collektive.engine

import java.util.concurrent.atomic.AtomicInteger
import java.util.concurrent.atomic.AtomicIntegerArray
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

    // Where the next range of each thread's share begins.
    private val next = AtomicIntegerArray(size * APART)
    private val busy = AtomicInteger()
    private var task = Task { _, _, _, _ -> }
    private var count = 0
    private var range = 1
    private var needed = 0

    // What a task threw: an error of ours, since rounds keep theirs.
    @Volatile
    private var failure: Throwable? = null

    @Volatile
    private var caller: Thread? = null

    // Until when idle threads stay awake.
    @Volatile
    private var awakeUntil = System.nanoTime()

    @Volatile
    var isClosed = false
        private set

    init {
        for (worker in workers) worker.thread.start()
    }

    /** Wakes the threads that the last work needed: the next comes soon. */
    fun wake() {
        awakeUntil = System.nanoTime() + WATCH_NANOS
        for (index in 0 until needed) LockSupport.unpark(workers[index].thread)
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
        caller = Thread.currentThread()
        needed = minOf(size, (count + range - 1) / range)
        for (share in 0 until needed) next[share * APART] = beginOf(share)
        busy.set(needed)
        for (index in 0 until needed) workers[index].start()
        val begin = System.nanoTime()
        while (busy.get() > 0) {
            val now = System.nanoTime()
            if (deadline - now <= 0) return false
            // A processor that falls asleep meanwhile takes longer to wake up than the rounds of a small network last.
            if (now - begin < WATCH_NANOS) Thread.yield() else LockSupport.parkNanos(this, deadline - now)
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

    /** Each thread has the same share each time, as long as the count is the same, since what it did last is in its caches; then it helps others. */
    private fun work(worker: Worker) {
        for (turn in 0 until needed) {
            val share = (worker.index + turn) % needed
            val end = beginOf(share + 1)
            while (!isClosed) {
                val begin = next.getAndAdd(share * APART, range)
                if (begin >= end) break
                task.run(worker.thread, worker.index, begin, minOf(begin + range, end))
            }
        }
    }

    private fun beginOf(share: Int): Int = (count.toLong() * share / needed).toInt()

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
                    if (System.nanoTime() - awakeUntil < 0) Thread.yield() else LockSupport.park(this@RoundPool)
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

    private companion object {
        // Threads write each other's shares rarely, and should not find them in one cache line.
        const val APART = 16
        const val WATCH_NANOS = 500_000L
    }
}
