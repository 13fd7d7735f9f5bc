package org.collektive.engine

import org.collektive.runtime.Export

/**
 * What a node sent in the last two rounds that gave an answer.
 *
 * Rounds of a tick read what was sent before it, also those that run beside the sender's round or after it: they read one place while
 * that round writes the other. So nothing has to be published when all rounds have ended.
 *
 * Threads: [send] by one at a time, [readable] by any at the same time; [last], [sentAt] and [sentTime] while no round runs.
 */
internal abstract class Outbox {
    // In a class of their own, whose fields stand before those of its subclass, side by side: neighbours read no more of a node.
    private var even: Export? = null
    private var odd: Export? = null

    // The lowest bit names the place of the last export; the others are its tick.
    private var stamp = 0L

    /** Simulated time of the round that sent [last]; 0 before. */
    var sentTime = 0.0
        private set

    /** What the last round that gave an answer sent; `null` before. */
    val last: Export? get() = at(stamp)

    /** Tick of that round; 0 before. */
    val sentAt: Long get() = stamp shr 1

    /** Makes [export], sent in [tick], the last one. */
    fun send(export: Export, tick: Long, time: Double) {
        export.tick = tick
        sentTime = time
        if (stamp and 1 == 0L) odd = export else even = export
        stamp = 2 * tick + (stamp.inv() and 1)
    }

    /** What was sent last before [tick], which is the present one or the next. */
    fun readable(tick: Long): Export? {
        val stamp = stamp
        // Without a branch: whether a neighbour has run already is as good as random.
        val isLater = 2 * tick - 1 - stamp ushr 63
        return at(stamp xor isLater)
    }

    /** See [Export.touch]. */
    fun touchExports(): Int = (even?.touch() ?: 0) + (odd?.touch() ?: 0)

    private fun at(stamp: Long): Export? = if (stamp and 1 == 0L) even else odd
}
