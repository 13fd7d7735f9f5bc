package org.collektive.runtime

import java.util.concurrent.atomic.AtomicIntegerFieldUpdater

/**
 * What a device sent in one round, to all its neighbours at once; read in place by any number of threads.
 *
 * Its device uses it for a later round when it is no more the last one and nobody holds it. Threads: any.
 */
public abstract class Export protected constructor() {
    @Volatile
    private var holders = 0

    /** Tick in which it was sent; the engine sets it, before any neighbour can see the export. */
    public var tick: Long = 0

    /** Whether someone counts on this export to stay as it is. */
    public val isHeld: Boolean get() = holders > 0

    /**
     * Reads what neighbours will read, so that it is in the processor's caches by then. The answer means nothing; who uses it keeps the
     * compiler from leaving the reads out.
     */
    public open fun touch(): Int = 0

    /** Keeps this export as it is until [release]; once for each holder. */
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
