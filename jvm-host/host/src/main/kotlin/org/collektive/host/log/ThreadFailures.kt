package org.collektive.host.log

import org.collektive.host.programs.ProgramLoader
import org.collektive.host.programs.RoundFailure
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.ShimCalls
import java.util.concurrent.ConcurrentHashMap
import java.util.concurrent.atomic.AtomicLong

/** Logs uncaught exceptions in threads of programs: the first of each kind in full, repetitions as a count. Safe on any thread. */
internal class ThreadFailures(private val shim: ShimCalls) : Thread.UncaughtExceptionHandler {
    private val counts = ConcurrentHashMap<String, AtomicLong>()

    override fun uncaughtException(thread: Thread, failure: Throwable) {
        try {
            val count = counts.computeIfAbsent(place(failure)) { AtomicLong() }.incrementAndGet()
            if (count == 1L) logFirst(failure)
            if (count > 1 && isPowerOfTen(count)) logCount(place(failure), count)
        } catch (_: Throwable) {
            // Memory is exhausted, so logging is impossible.
        }
    }

    /** Logs the count of each exception that was repeated, and resets all counts. */
    fun logCounts() {
        for ((place, count) in counts) if (count.get() > 1) logCount(place, count.get())
        counts.clear()
    }

    private fun logFirst(failure: Throwable) {
        val description = RoundFailure.describe(failure, null)
        shim.log(LogLevel.ERROR, HostLog.attributed("an uncaught exception ended the thread: $description"))
    }

    private fun logCount(place: String, count: Long) {
        shim.log(LogLevel.ERROR, "$count times so far, an uncaught exception ended a thread: $place")
    }

    /** Two exceptions are of the same kind if they have the same class and origin. */
    private fun place(failure: Throwable): String {
        val frames = failure.stackTrace
        val own = frames.firstOrNull { it.classLoaderName == ProgramLoader.NAME } ?: frames.firstOrNull()
        return "${failure.javaClass.name} at $own"
    }

    private fun isPowerOfTen(count: Long): Boolean {
        var power = 10L
        while (power < count) power *= 10
        return power == count
    }
}
