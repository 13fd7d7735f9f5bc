package org.collektive.host.jfr

import org.collektive.api.Device
import org.collektive.engine.RoundThread

/** Which rounds become events: one in [EVERY] of each thread. All of them would cost more than many a round. */
internal object ProgramRounds {
    /** Prime, so that the nodes take turns whatever their number. */
    const val EVERY = 17

    /** Asked only whether such events are wanted; made at its first use. */
    private object Sample {
        @JvmField
        val event = ProgramRoundEvent()
    }

    /** A begun event for the round that begins on this thread, or `null`: the usual case, and a few nanoseconds. */
    fun begin(): ProgramRoundEvent? {
        if (!SessionEvents.wanted || !Sample.event.isEnabled) return null
        val thread = Thread.currentThread() as? RoundThread ?: return null
        if (thread.rounds % EVERY != 0L) return null
        return ProgramRoundEvent().apply { begin() }
    }

    fun end(event: ProgramRoundEvent, device: Device, program: String, function: String, exports: Int) {
        event.end()
        if (!event.shouldCommit()) return
        event.node = device.id
        event.program = program
        event.function = function
        event.exports = exports
        event.commit()
    }
}
