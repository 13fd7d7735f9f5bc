package org.collektive.host

import org.collektive.frames.frameIn
import org.collektive.host.log.HostLog
import org.collektive.host.session.Session
import org.collektive.host.session.SessionOpening
import org.collektive.host.session.orClose
import org.collektive.host.session.reading
import org.collektive.host.shim.Debugger
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.NativeShim
import org.collektive.host.shim.ShimCalls
import java.nio.ByteBuffer
import java.util.concurrent.TimeUnit

/**
 * The entry points that the shim calls, always on its engine thread. Times are in milliseconds.
 *
 * [open], [step] and [control] read a request from the bytes `offset until offset + length` of `request`, and write their answer to the
 * buffer `answer` of `slot`. They return the answer's position in bytes, `offset << 32 | length`. On failure they pass the message to
 * [org.collektive.host.shim.Shim.error] and return a negative code of `CLK_ERRORS`; they never throw. The shim owns all buffers.
 */
public object Host {
    /** The shim that the host calls; the native library by default. Replace it only before [start]. */
    public var shim: ShimCalls = NativeShim

    // A list, because its look-up and removal neither allocate nor load classes and so work with an exhausted heap.
    private val sessions = ArrayList<OpenSession>()
    private val control by lazy { Control(shim) }
    private var log: HostLog? = null

    /**
     * Redirects standard output, `java.util.logging` and uncaught exceptions to the shim's log. Call it once, before all other functions.
     *
     * @return one line that describes this host and its JVM.
     */
    @JvmStatic
    public fun start(): String {
        log = HostLog(shim).also(HostLog::install)
        Debugger.watch(shim)
        return "Collektive host, protocol ${SessionOpening.PROTOCOL}, Java ${Runtime.version()} (${System.getProperty("java.vm.name")}, " +
            "${System.getProperty("java.vendor")})"
    }

    /** Opens the session of the `OpenRequest` in [request]. */
    @JvmStatic
    public fun open(session: Long, request: ByteBuffer, offset: Int, length: Int, slot: Long, answer: ByteBuffer, limitMillis: Int): Long =
        answering {
            requireLimit(limitMillis)
            if (indexOf(session) >= 0) throw HostException(HostError.ARGUMENT, "session $session is already open")
            log?.install()
            SessionOpening.open(frame(request, offset, length), shim).orClose { opened ->
                opened.answerOpen(slot, answer).also { sessions += OpenSession(session, opened) }
            }
        }

    /** Runs the tick of the `StepRequest` in [request]. */
    @JvmStatic
    public fun step(session: Long, request: ByteBuffer, offset: Int, length: Int, slot: Long, answer: ByteBuffer, limitMillis: Int): Long =
        answering {
            val begin = System.nanoTime()
            requireLimit(limitMillis)
            val index = indexOf(session)
            if (index < 0) throw HostException(HostError.HANDLE, "unknown session $session")
            sessions[index].session.step(frame(request, offset, length), slot, answer, begin, millis(limitMillis))
        }

    /** Processes the `ControlRequest` in [request], which concerns the JVM and not a session: [session] must be 0. */
    @JvmStatic
    public fun control(
        session: Long,
        request: ByteBuffer,
        offset: Int,
        length: Int,
        slot: Long,
        answer: ByteBuffer,
        limitMillis: Int,
    ): Long = answering {
        requireLimit(limitMillis)
        if (session != 0L) throw HostException(HostError.ARGUMENT, "the session of a control request must be 0, but is $session")
        control.answer(frame(request, offset, length), slot, answer)
    }

    /** Closes [session]. Does nothing if the id is unknown. */
    @JvmStatic
    public fun close(session: Long) {
        val index = indexOf(session)
        if (index >= 0) sessions.removeAt(index).session.close()
        log?.logCounts()
    }

    /**
     * Closes all sessions and interrupts the non-daemon threads that programs started, because the JVM waits for them on exit.
     *
     * @return whether all of them ended within [limitMillis].
     */
    @JvmStatic
    public fun stop(limitMillis: Int): Boolean {
        sessions.forEach { it.session.close() }
        sessions.clear()
        val deadline = System.nanoTime() + millis(limitMillis)
        control.close(limitMillis)
        val remaining = Thread.getAllStackTraces().keys.filter {
            !it.isDaemon && it !== Thread.currentThread() && it.name != "DestroyJavaVM"
        }
        remaining.forEach(Thread::interrupt)
        for (thread in remaining) {
            val wait = TimeUnit.NANOSECONDS.toMillis(deadline - System.nanoTime())
            if (wait > 0) thread.join(wait)
            if (thread.isAlive) {
                shim.log(
                    LogLevel.WARNING,
                    "thread \"${thread.name}\" of a program was still running and was stopped with the JVM; " +
                        "end the thread when it is interrupted",
                )
            }
        }
        return remaining.none(Thread::isAlive)
    }

    private fun frame(slot: ByteBuffer, offset: Int, length: Int) = reading { frameIn(slot, offset, length) }

    private fun indexOf(id: Long): Int {
        for (index in sessions.indices) if (sessions[index].id == id) return index
        return -1
    }

    private class OpenSession(val id: Long, val session: Session)

    private fun millis(limit: Int) = TimeUnit.MILLISECONDS.toNanos(limit.toLong())

    private fun requireLimit(limitMillis: Int) {
        if (limitMillis < 1) throw HostException(HostError.ARGUMENT, "the limit is $limitMillis ms; it must be 1 or greater")
    }

    private inline fun answering(work: () -> Long): Long {
        val failure = try {
            return work()
        } catch (e: HostException) {
            e
        } catch (e: Throwable) {
            // Exceptions must not reach the shim, which gets a code and a message instead.
            HostException(HostError.JAVA, "unexpected: ${describeSafely(e)}", e)
        }
        shim.error(failure.message.orEmpty())
        return failure.error.code.toLong()
    }

    private fun describeSafely(e: Throwable): String = try {
        e.stackTraceToString()
    } catch (_: Throwable) {
        e.javaClass.name
    }
}
