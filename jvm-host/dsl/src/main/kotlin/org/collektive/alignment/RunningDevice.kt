package org.collektive.alignment

import it.unibo.collektive.aggregate.api.Aggregate

/** Holds the device whose round runs on a thread. Runtimes keep the instance of a thread, because each look-up takes several nanoseconds. */
public class RunningDevice private constructor() {
    @PublishedApi
    internal var device: Aggregate<*>? = null

    /** Runs a [round] of [device]. Rounds may be nested. */
    public inline fun <R> run(device: Aggregate<*>, round: () -> R): R {
        val outer = this.device
        this.device = device
        try {
            return round()
        } finally {
            this.device = outer
        }
    }

    public companion object {
        private val ofThread = ThreadLocal.withInitial { RunningDevice() }

        /** Returns the instance of this thread. Use it only on this thread. */
        public fun ofThread(): RunningDevice = ofThread.get()
    }
}
