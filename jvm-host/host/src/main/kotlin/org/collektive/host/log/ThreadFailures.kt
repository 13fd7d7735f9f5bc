package org.collektive.host.log

import org.collektive.host.programs.ProgramLoader
import org.collektive.host.programs.RoundFailure
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.ShimCalls
import java.util.concurrent.ConcurrentHashMap
import java.util.concurrent.atomic.AtomicLong

/** Exceptions that end threads of programs: each is logged when it first comes, then counted. */
internal class ThreadFailures(private val shim: ShimCalls) : Thread.UncaughtExceptionHandler {
    private val counts = ConcurrentHashMap<String, AtomicLong>()

    override fun uncaughtException(thread: Thread, failure: Throwable) {
        try {
            val count = counts.computeIfAbsent(place(failure)) { AtomicLong() }.incrementAndGet()
            if (count == 1L) shim.log(LogLevel.ERROR, HostLog.attributed("an uncaught exception ended the thread: ${RoundFailure.describe(failure, null)}"))
            if (count > 1 && isPowerOfTen(count)) tell(place(failure), count)
        } catch (_: Throwable) {
            // Memory is short: there is nothing left to say it with.
        }
    }

    /** Logs the number of each exception that came more than once, and forgets them. */
    fun tellCounts() {
        for ((place, count) in counts) if (count.get() > 1) tell(place, count.get())
        counts.clear()
    }

    private fun tell(place: String, count: Long) {
        shim.log(LogLevel.ERROR, "$count times so far, an uncaught exception ended a thread: $place")
    }

    /** Exceptions of one class from one place are one and the same. */
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
