package org.collektive.host

import java.nio.ByteBuffer
import java.util.concurrent.TimeUnit

/**
 * What the shim calls, always on its engine thread.
 *
 * [open] and [step] return `offset << 32 | length` of the answer in the slot, or a negative code of `CLK_ERRORS` after
 * [Shim.error]. Times are milliseconds.
 */
public object Host {
    /** Number of the contract in `schema/frame.fbs` and of these entries. */
    internal const val PROTOCOL = 1

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
        return "Collektive host, protocol $PROTOCOL, Java ${Runtime.version()} (${System.getProperty("java.vm.name")}, " +
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
        val frame = FrameVerifier.frame(request, offset, length)
        val opened = Session.open(frame, shim)
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
        sessions[index].session.step(FrameVerifier.frame(request, offset, length), slot, answer, begin, begin + millis(limitMillis))
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
        control.answer(FrameVerifier.frame(request, offset, length), slot, answer)
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
