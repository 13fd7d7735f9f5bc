package org.collektive.host

import org.collektive.frames.frameIn
import org.collektive.host.log.HostLog
import org.collektive.host.session.Session
import org.collektive.host.session.SessionOpening
import org.collektive.host.session.reading
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import org.collektive.host.shim.LogLevel
import org.collektive.host.shim.NativeShim
import org.collektive.host.shim.ShimCalls
import java.nio.ByteBuffer
import java.util.concurrent.TimeUnit

/**
 * What the shim calls, always on its engine thread.
 *
 * [open] and [step] return `offset << 32 | length` of the answer in the slot, or a negative code of `CLK_ERRORS` after
 * [org.collektive.host.shim.Shim.error]. Times are milliseconds.
 */
public object Host {
    /** What stands behind the host: the native library, unless another is set before [start]. */
    public var shim: ShimCalls = NativeShim

    // Found and removed without allocating, or loading a class: that must work with the heap exhausted.
    private val sessions = ArrayList<OpenSession>()
    private val control by lazy { Control(shim) }
    private var log: HostLog? = null

    /** Takes over standard output, `java.util.logging` and uncaught exceptions. Once; returns one line about this host and its JVM. */
    @JvmStatic
    public fun start(): String {
        log = HostLog(shim).also(HostLog::install)
        return "Collektive host, protocol ${SessionOpening.PROTOCOL}, Java ${Runtime.version()} (${System.getProperty("java.vm.name")}, " +
            "${System.getProperty("java.vendor")})"
    }

    /** Opens the session of the `OpenRequest` in [request]. */
    @JvmStatic
    public fun open(
        session: Long,
        request: ByteBuffer,
        offset: Int,
        length: Int,
        slot: Long,
        answer: ByteBuffer,
        limitMillis: Int,
    ): Long = answering {
        requireLimit(limitMillis)
        if (indexOf(session) >= 0) throw HostException(HostError.ARGUMENT, "session $session is open already")
        log?.install()
        val opened = SessionOpening.open(frame(request, offset, length), shim)
        try {
            opened.answerOpen(slot, answer).also { sessions += OpenSession(session, opened) }
        } catch (e: Throwable) {
            opened.close()
            throw e
        }
    }

    /** Runs the tick of the `StepRequest` in [request]. */
    @JvmStatic
    public fun step(
        session: Long,
        request: ByteBuffer,
        offset: Int,
        length: Int,
        slot: Long,
        answer: ByteBuffer,
        limitMillis: Int,
    ): Long = answering {
        val begin = System.nanoTime()
        requireLimit(limitMillis)
        val index = indexOf(session)
        if (index < 0) throw HostException(HostError.HANDLE, "there is no session $session")
        sessions[index].session.step(frame(request, offset, length), slot, answer, begin, begin + millis(limitMillis))
    }

    /** Answers the `ControlRequest` in [request]; it belongs to no session, so [session] is 0. */
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
        if (session != 0L) throw HostException(HostError.ARGUMENT, "a control belongs to no session, but names $session")
        control.answer(frame(request, offset, length), slot, answer)
    }

    /** Closes [session]; an unknown one is ignored. */
    @JvmStatic
    public fun close(session: Long) {
        val index = indexOf(session)
        if (index >= 0) sessions.removeAt(index).session.close()
        log?.tellCounts()
    }

    /**
     * Closes all sessions and asks the programs' own threads to end, since the JVM would wait for them.
     *
     * @return whether none is left after [limitMillis].
     */
    @JvmStatic
    public fun stop(limitMillis: Int): Boolean {
        sessions.forEach { it.session.close() }
        sessions.clear()
        val deadline = System.nanoTime() + millis(limitMillis)
        control.close(limitMillis)
        val left = Thread.getAllStackTraces().keys.filter { !it.isDaemon && it !== Thread.currentThread() && it.name != "DestroyJavaVM" }
        left.forEach(Thread::interrupt)
        for (thread in left) {
            val wait = TimeUnit.NANOSECONDS.toMillis(deadline - System.nanoTime())
            if (wait > 0) thread.join(wait)
            if (thread.isAlive) shim.log(LogLevel.WARNING, "thread \"${thread.name}\" of a program does not end, and is halted with the JVM")
        }
        return left.none(Thread::isAlive)
    }

    private fun frame(slot: ByteBuffer, offset: Int, length: Int) = reading({ "the frame" }) { frameIn(slot, offset, length) }

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
            // The last line of defence: whatever it is, the shim gets a code and a text.
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
