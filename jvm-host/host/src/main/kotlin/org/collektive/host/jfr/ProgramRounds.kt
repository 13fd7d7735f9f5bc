package org.collektive.host.jfr

import org.collektive.engine.RoundDevice
import org.collektive.engine.RoundThread

/** Samples the rounds that become events: one in [EVERY] per thread. An event for every round would cost more than a short round. */
public object ProgramRounds {
    /** A prime, so that the sampled nodes change from tick to tick. */
    public const val EVERY: Int = 17

    /** Only answers whether such events are enabled. Its class loads on first use. */
    private object Sample {
        @JvmField
        val event = ProgramRoundEvent()
    }

    /** Begins an event for the round that begins on this thread; `null` if it is not sampled. Without a recording it takes nanoseconds. */
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
