package org.collektive.spi

import java.util.concurrent.atomic.AtomicIntegerFieldUpdater

/**
 * The messages of one device's round to all its neighbours. Receivers read it in place, on any thread.
 *
 * Once another export has replaced it and it is not retained, the device reuses it for a later round.
 */
public abstract class Export protected constructor() {
    @Volatile
    private var references = 0

    /** The tick in which the export was sent. The engine sets it before neighbours can read the export. */
    public var tick: Long = 0

    /** Whether a reference still prevents the reuse of this export. */
    public val isRetained: Boolean get() = references > 0

    /** Prefetches into the CPU cache the data that neighbours read. The result only prevents the JIT from removing the reads. */
    public open fun touch(): Int = 0

    /** Adds the values of this message to [size]. Call it only while no round runs. */
    public open fun measure(size: MessageSize) {}

    /** Prevents the reuse of this export until the matching [release]. */
    public fun retain() {
        REFERENCES.incrementAndGet(this)
    }

    /** Ends one [retain]. */
    public fun release() {
        check(REFERENCES.decrementAndGet(this) >= 0) { "export released more often than retained" }
    }

    private companion object {
        val REFERENCES: AtomicIntegerFieldUpdater<Export> = AtomicIntegerFieldUpdater.newUpdater(Export::class.java, "references")
    }
}
