package org.collektive.host.jfr

import org.collektive.engine.RoundDevice
import org.collektive.engine.RoundThread

/** Which rounds become events: one in [EVERY] of each thread. All of them would cost more than many a round. */
public object ProgramRounds {
    /** Prime, so that the nodes take turns whatever their number. */
    public const val EVERY: Int = 17

    /** Asked only whether such events are wanted; made at its first use. */
    private object Sample {
        @JvmField
        val event = ProgramRoundEvent()
    }

    /** A begun event for the round that begins on this thread, or `null`: the usual case, and a few nanoseconds. */
    internal fun begin(): ProgramRoundEvent? {
        if (!SessionEvents.wanted || !Sample.event.isEnabled) return null
        val thread = Thread.currentThread() as? RoundThread ?: return null
        if (thread.rounds % EVERY != 0L) return null
        return ProgramRoundEvent().apply { begin() }
    }

    internal fun end(event: ProgramRoundEvent, device: RoundDevice, program: String, function: String) {
        event.end()
        if (!event.shouldCommit()) return
        event.node = device.id
        event.program = program
        event.function = function
        event.exports = device.exports
        event.commit()
    }
}
