package org.collektive.host.jfr

import org.collektive.engine.RoundDevice
import org.collektive.engine.RoundThread

/** Samples rounds for JFR events: one in [INTERVAL] per thread, because an event would cost more than a short round. */
public object RoundSampling {
    /** Number of rounds per sample: a prime, so that the sampled nodes change from tick to tick. */
    public const val INTERVAL: Int = 17

    /** An event that is only used to check whether these events are enabled. Loaded on first use. */
    private object Sample {
        @JvmField
        val event = ProgramRoundEvent()
    }

    /** Starts an event for the current round of this thread; `null` if it is not sampled. Takes nanoseconds without a recording. */
    internal fun begin(): ProgramRoundEvent? {
        if (!SessionEvents.isRecorderInitialized || !Sample.event.isEnabled) return null
        val thread = Thread.currentThread() as? RoundThread ?: return null
        if (thread.rounds % INTERVAL != 0L) return null
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
