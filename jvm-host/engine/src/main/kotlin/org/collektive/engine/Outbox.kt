package org.collektive.engine

import org.collektive.spi.Export

/**
 * What a node sent in its last two rounds that gave an answer.
 *
 * Rounds of a tick read what was sent before the tick, even beside or after the sender's own round: they read one slot while that
 * round writes the other. So there is no second pass that publishes exports.
 *
 * Threads: [send] by one at a time, [readable] by any at the same time; [last], [sentAt] and [sentTime] while no round runs.
 */
internal abstract class Outbox {
    // A superclass's fields come first in the object, side by side: neighbours read nothing else of a node.
    private var even: Export? = null
    private var odd: Export? = null

    // Lowest bit: slot of the last export; other bits: its tick.
    private var stamp = 0L

    /** Simulated seconds of the round that sent [last]; 0 before the first. */
    var sentTime = 0.0
        private set

    /** What the last round that gave an answer sent; `null` before the first. */
    val last: Export? get() = at(stamp)

    /** Tick of that round; 0 before the first. */
    val sentAt: Long get() = stamp shr 1

    /** Makes [export], sent in [tick], the last one. */
    fun send(export: Export, tick: Long, time: Double) {
        export.tick = tick
        sentTime = time
        if (stamp and 1 == 0L) odd = export else even = export
        stamp = 2 * tick + (stamp.inv() and 1)
    }

    /** The last export from before [tick], which is the present tick or the next. */
    fun readable(tick: Long): Export? {
        val stamp = stamp
        // Branchless: whether a neighbour has run already is unpredictable.
        val isLater = 2 * tick - 1 - stamp ushr 63
        return at(stamp xor isLater)
    }

    /** See [Export.touch]. */
    fun touchExports(): Int = (even?.touch() ?: 0) + (odd?.touch() ?: 0)

    private fun at(stamp: Long): Export? = if (stamp and 1 == 0L) even else odd
}
