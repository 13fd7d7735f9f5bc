package org.collektive.engine

import java.util.concurrent.atomic.AtomicInteger
import java.util.concurrent.atomic.AtomicIntegerArray
import java.util.concurrent.locks.LockSupport
import java.util.function.LongSupplier

/**
 * The threads that run the rounds of one session. Call [run] from one thread at a time; it allocates nothing.
 *
 * Threads process ranges of indices. The assignment of ranges to threads depends on timing, so the results of a task must not depend on
 * their order. If a thread cannot start, the others end.
 */
internal class RoundPool @JvmOverloads constructor(
    private val size: Int,
    private val limitClock: LongSupplier = LongSupplier(System::nanoTime),
    start: (Thread) -> Unit = Thread::start,
) {
    /** Processes the indices `begin until end` of [input] on the thread [worker]. */
    fun interface Task<in T> {
        fun run(input: T, thread: RoundThread, worker: Int, begin: Int, end: Int)
    }

    private val workers = Array(size) { Worker(it) }

    // Start of the next range in each thread's share.
    private val next = AtomicIntegerArray(size * PADDING)
    private val busy = AtomicInteger()
    private var task = Task<Any?> { _, _, _, _, _ -> }
    private var input: Any? = null
    private var count = 0
    private var range = 1
    private var needed = 0

    // The exception of a task: a bug in the engine, because tasks catch the exceptions of programs.
    @Volatile
    private var failure: Throwable? = null

    @Volatile
    private var caller: Thread? = null

    // The value of System.nanoTime() until which idle threads spin.
    @Volatile
    private var spinUntil = System.nanoTime()

    @Volatile
    var isClosed = false
        private set

    init {
        try {
            for (worker in workers) start(worker.thread)
        } catch (e: Throwable) {
            abandon()
            throw e
        }
    }

    /** Wakes the threads that the last [run] used. They spin for up to [SPIN_NANOS] until the next [run]. */
    fun wake() {
        spinUntil = System.nanoTime() + SPIN_NANOS
        for (index in 0 until needed) LockSupport.unpark(workers[index].thread)
    }

    /**
     * Runs [task] on [input] over `0 until count` in ranges of [range] indices, and waits for the end.
     *
     * @return `false` if the limit clock passed [deadline] first; the caller must then [abandon] the pool.
     */
    fun <T> run(task: Task<T>, input: T, count: Int, range: Int, deadline: Long): Boolean {
        if (count == 0) return true
        @Suppress("UNCHECKED_CAST") // The task is called only with this input.
        this.task = task as Task<Any?>
        this.input = input
        this.count = count
        this.range = range
        caller = Thread.currentThread()
        needed = minOf(size, (count + range - 1) / range)
        for (share in 0 until needed) next[share * PADDING] = shareBegin(share)
        busy.set(needed)
        for (index in 0 until needed) workers[index].start()
        val begin = System.nanoTime()
        while (busy.get() > 0) {
            val left = deadline - limitClock.asLong
            if (left <= 0) return false
            // Spins briefly, because waking an idle core takes longer than the rounds of a small network.
            if (System.nanoTime() - begin < SPIN_NANOS) Thread.yield() else LockSupport.parkNanos(this, left)
        }
        failure?.let { throw IllegalStateException("an engine thread failed; this is a bug in the engine", it) }
        return true
    }

    /** Ends idle threads and interrupts busy ones, which end after their round. */
    fun abandon() {
        isClosed = true
        for (worker in workers) worker.thread.interrupt()
    }

    /** Returns the stack trace of each thread, for the log. */
    fun dump(): String = buildString {
        for (worker in workers) {
            val thread = worker.thread
            append('"').append(thread.name).append("\" ").append(thread.state)
            if (thread.node >= 0) append(", in the round of node ").append(thread.node)
            append('\n')
            for (frame in thread.stackTrace) append("    at ").append(frame).append('\n')
        }
    }

    /**
     * Processes the share of this thread, then helps other threads. The same count always gives the same shares, so a thread's nodes stay
     * in its cache.
     */
    private fun work(worker: Worker) {
        for (turn in 0 until needed) {
            val share = (worker.index + turn) % needed
            val end = shareBegin(share + 1)
            while (!isClosed) {
                val begin = next.getAndAdd(share * PADDING, range)
                if (begin >= end) break
                task.run(input, worker.thread, worker.index, begin, minOf(begin + range, end))
            }
        }
    }

    private fun shareBegin(share: Int): Int = (count.toLong() * share / needed).toInt()

    private inner class Worker(val index: Int) : Runnable {
        val thread = RoundThread("collektive-round-$index", this)

        @Volatile
        private var hasWork = false

        fun start() {
            hasWork = true
            LockSupport.unpark(thread)
        }

        override fun run() {
            while (!isClosed) {
                if (!hasWork) {
                    if (System.nanoTime() - spinUntil < 0) Thread.yield() else LockSupport.park(this@RoundPool)
                    continue
                }
                hasWork = false
                try {
                    work(this)
                } catch (e: Throwable) {
                    failure = e
                }
                // A program may have left the thread interrupted, which would make park() return immediately.
                Thread.interrupted()
                if (busy.decrementAndGet() == 0) LockSupport.unpark(caller)
            }
        }
    }

    private companion object {
        // Distance between counters, in ints, to avoid false sharing.
        const val PADDING = 16
        const val SPIN_NANOS = 500_000L
    }
}
