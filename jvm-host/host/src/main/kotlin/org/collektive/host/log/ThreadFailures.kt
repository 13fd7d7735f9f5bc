package org.collektive.host.log

import org.collektive.host.programs.ProgramLoader
import org.collektive.host.programs.RoundFailure
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.ShimCalls
import java.util.concurrent.ConcurrentHashMap
import java.util.concurrent.atomic.AtomicLong

/** Logs uncaught exceptions in threads of programs: the first of each kind in full, repetitions as a count. Thread-safe. */
internal class ThreadFailures(private val shim: ShimCalls) : Thread.UncaughtExceptionHandler {
    private val counts = ConcurrentHashMap<String, AtomicLong>()

    override fun uncaughtException(thread: Thread, failure: Throwable) {
        try {
            val count = counts.computeIfAbsent(kind(failure)) { AtomicLong() }.incrementAndGet()
            if (count == 1L) logFirst(failure)
            if (count > 1 && isPowerOfTen(count)) logCount(kind(failure), count)
        } catch (_: Throwable) {
            // Logging fails only if memory is exhausted.
        }
    }

    /** Logs the count of each exception that was repeated, and resets all counts. */
    fun logCounts() {
        for ((kind, count) in counts) if (count.get() > 1) logCount(kind, count.get())
        counts.clear()
    }

    private fun logFirst(failure: Throwable) {
        val description = RoundFailure.describe(failure, null)
        shim.log(LogLevel.ERROR, HostLog.attributed("an uncaught exception ended the thread: $description"))
    }

    private fun logCount(kind: String, count: Long) {
        shim.log(LogLevel.ERROR, "an uncaught exception ended a thread $count times so far: $kind")
    }

    /** Returns the class and origin of [failure]; exceptions of the same kind have the same result. */
    private fun kind(failure: Throwable): String {
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
