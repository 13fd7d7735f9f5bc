package org.collektive.spi

import java.util.concurrent.atomic.AtomicIntegerFieldUpdater

/**
 * What a device sent in one round, to all its neighbours at once; read in place. Threads: any.
 *
 * Once a later export replaced it and nobody holds it, its device reuses it for another round.
 */
public abstract class Export protected constructor() {
    @Volatile
    private var holders = 0

    /** Tick in which it was sent; set by the engine before any neighbour can see the export. */
    public var tick: Long = 0

    /** Whether somebody relies on this export to stay as it is. */
    public val isHeld: Boolean get() = holders > 0

    /** Reads what neighbours will read, to have it in the processor's caches. The result only keeps the JIT from dropping the reads. */
    public open fun touch(): Int = 0

    /** Keeps this export as it is until [release]; once per holder. */
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
