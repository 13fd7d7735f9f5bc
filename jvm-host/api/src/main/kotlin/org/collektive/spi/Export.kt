package org.collektive.spi

import java.util.concurrent.atomic.AtomicIntegerFieldUpdater

/**
 * The messages of one device's round to all its neighbours. Receivers read it in place, on any thread.
 *
 * The device reuses it for another round once a later export has replaced it and nobody holds it.
 */
public abstract class Export protected constructor() {
    @Volatile
    private var holders = 0

    /** The tick in which it was sent. The engine sets it before it publishes the export to neighbours. */
    public var tick: Long = 0

    /** Whether a holder still prevents its reuse. */
    public val isHeld: Boolean get() = holders > 0

    /** Prefetches what neighbours will read into the CPU cache. The result only keeps the JIT from removing the reads. */
    public open fun touch(): Int = 0

    /** Prevents the reuse of this export until [release]. Each holder calls it once. */
    public fun hold() {
        HOLDERS.incrementAndGet(this)
    }

    /** Ends one [hold]. */
    public fun release() {
        check(HOLDERS.decrementAndGet(this) >= 0) { "an export was released more often than held" }
    }

    private companion object {
        val HOLDERS: AtomicIntegerFieldUpdater<Export> = AtomicIntegerFieldUpdater.newUpdater(Export::class.java, "holders")
    }
}
