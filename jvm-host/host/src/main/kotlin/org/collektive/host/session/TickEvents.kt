package org.collektive.host.session

import org.collektive.engine.TickResult
import org.collektive.host.jfr.ProgramErrorEvent
import org.collektive.host.jfr.SessionEvents

/** Emits the events of one session's ticks once the flight recorder is initialised. Allocates only for failed rounds. */
internal class TickEvents {
    private var events = SessionEvents.ofRecorder()
    private var called = 0L
    private var written = 0L
    private var lastEnd = 0L

    /** Marks the start of a tick, whose host call started at [called] on the clock of `System.nanoTime()`. */
    fun begin(called: Long) {
        this.called = called
        if (events == null) events = SessionEvents.ofRecorder()
        events?.tick?.begin()
    }

    /** Marks the end of the rounds and the start of writing the answer. */
    fun write() {
        written = System.nanoTime()
    }

    /** Marks the end of the tick; its request has [bytesIn] bytes, its response [bytesOut]. */
    fun end(result: TickResult, bytesIn: Int, bytesOut: Int) {
        val end = System.nanoTime()
        val events = events
        if (events != null) {
            tick(events, result, bytesIn, bytesOut, end)
            network(events, result)
            if (result.failureCount > 0) errors(result)
        }
        lastEnd = end
    }

    /** Marks the end of the session after [ticks] ticks. [failure] is `null` if it ended normally. */
    fun close(ticks: Long, failure: String?) {
        val event = (events ?: SessionEvents.ofRecorder())?.end ?: return
        event.ticks = ticks
        event.failure = failure
        event.commit()
    }

    private fun tick(events: SessionEvents, result: TickResult, bytesIn: Int, bytesOut: Int, end: Long) {
        val event = events.tick
        event.end()
        if (!event.shouldCommit()) return
        event.tick = result.tick
        event.nodes = result.nodeCount
        event.dueNodes = result.size
        event.failedRounds = result.failureCount
        event.links = result.linkCount
        event.bytesIn = bytesIn.toLong()
        event.bytesOut = bytesOut.toLong()
        event.wait = if (lastEnd == 0L) 0 else called - lastEnd
        event.rounds = result.roundNanos
        event.write = end - written
        event.commit()
    }

    private fun network(events: SessionEvents, result: TickResult) {
        val event = events.network
        if (!event.isEnabled) return
        event.begin() // a reused event keeps its first start time otherwise
        event.tick = result.tick
        event.sent = result.network.sent
        event.dropped = result.network.dropped
        event.delayed = result.network.delayed
        event.expired = result.network.expired
        event.commit()
    }

    private fun errors(result: TickResult) {
        for (index in 0 until result.size) {
            val message = result.failure(index) ?: continue
            val event = ProgramErrorEvent()
            if (!event.isEnabled) return
            event.tick = result.tick
            event.node = result.id(index)
            event.program = result.program(index).name
            event.message = message
            event.commit()
        }
    }
}
