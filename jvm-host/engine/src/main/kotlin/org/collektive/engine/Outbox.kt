package org.collektive.engine

import org.collektive.spi.Export

/**
 * The exports of a node's last two successful rounds.
 *
 * All rounds of a tick read a node's export from before the tick, even during or after the node's own round, which writes the other slot.
 * With two slots, no second pass is needed to publish exports.
 *
 * Thread safety: one thread at a time may call [send], while any thread may call [readable]. Read [last], [sentAt] and [sentTime] only
 * while no round runs.
 */
internal abstract class Outbox {
    // Neighbours read only these fields of a node. Because they are in a superclass, they are adjacent and share a cache line.
    private var even: Export? = null
    private var odd: Export? = null

    // Lowest bit: slot of the last export; other bits: its tick.
    private var stamp = 0L

    /** Simulated time of the round that sent [last], in seconds; 0 before the first. */
    var sentTime = 0.0
        private set

    /** The export of the last successful round; `null` before the first. */
    val last: Export? get() = at(stamp)

    /** Tick of [last]; 0 before the first. */
    val sentAt: Long get() = stamp shr 1

    /** Makes [export] the [last] one, sent at [time] in simulated seconds. */
    fun send(export: Export, tick: Long, time: Double) {
        export.tick = tick
        sentTime = time
        if (stamp and 1 == 0L) odd = export else even = export
        stamp = 2 * tick + (stamp.inv() and 1)
    }

    /** Returns the last export from before [tick], which must be the current or the next tick. */
    fun readable(tick: Long): Export? {
        val stamp = stamp
        // Branchless, because a branch predictor cannot guess whether a neighbour has run.
        val isLater = 2 * tick - 1 - stamp ushr 63
        return at(stamp xor isLater)
    }

    /** See [Export.touch]. */
    fun prefetchExports(): Int = (even?.touch() ?: 0) + (odd?.touch() ?: 0)

    private fun at(stamp: Long): Export? = if (stamp and 1 == 0L) even else odd
}
