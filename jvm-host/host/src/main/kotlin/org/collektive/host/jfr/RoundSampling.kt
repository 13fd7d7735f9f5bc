package org.collektive.host.jfr

import org.collektive.engine.RoundDevice
import org.collektive.engine.RoundThread

/** Samples rounds for JFR events: one in [INTERVAL] per thread, because an event would cost more than a short round. */
public object RoundSampling {
    /** Number of rounds per sample. */
    public const val INTERVAL: Int = 17

    /** The fraction of the golden ratio, in units of 2^-64. */
    private const val GOLDEN_RATIO = -0x61c8864680b583ebL

    /** An event that is only used to check whether these events are enabled. Loaded on first use. */
    private object Sample {
        @JvmField
        val event = ProgramRoundEvent()
    }

    /** Starts an event for the current round of this thread; `null` if it is not sampled. Takes nanoseconds without a recording. */
    internal fun begin(): ProgramRoundEvent? {
        if (!SessionEvents.isRecorderInitialized || !Sample.event.isEnabled) return null
        val thread = Thread.currentThread() as? RoundThread ?: return null
        if (!isSampled(thread.rounds - 1)) return null
        return ProgramRoundEvent().apply { begin() }
    }

    /** Selects one of [INTERVAL] successive rounds. Its place changes, so that all nodes are sampled even if their number is a multiple. */
    private fun isSampled(round: Long): Boolean {
        val fraction = round / INTERVAL * GOLDEN_RATIO ushr Int.SIZE_BITS
        return round % INTERVAL == fraction * INTERVAL ushr Int.SIZE_BITS
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
