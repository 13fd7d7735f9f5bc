package org.collektive.engine

/**
 * Decides loss and delay of messages on one thread, and counts them.
 *
 * The decision depends only on the seed, the tick of sending, and the ids of sender and receiver.
 */
internal class Transmitter(private val model: NetworkModel, private val seed: Long, private val clock: Clock) {
    val counts = NetworkCounts()
    private val words = IntArray(4)

    /** Seconds by which equal times may differ, because sums of tick lengths are inexact. */
    private val tolerance get() = clock.deltaTime * TOLERANCE

    /** Sends the last message of the node [id], whose outbox is [from], on the [channel] of its link to the node [to]. */
    fun send(id: Int, from: Outbox, to: Int, length: Float, attenuation: Float, channel: Channel) {
        val export = from.last ?: return
        counts.sent++
        val burstLoss = if (model.burstShare > 0.0 && isBad(id, from.sentAt, to, channel)) model.burstLoss else 0.0
        draw(id, from.sentAt, to, PURPOSE)
        val loss = (model.loss + model.lossPerMetre * length + model.lossPerAttenuation * attenuation).coerceAtMost(1.0)
        if (uniform(words[0], words[1]) < loss + (1.0 - loss) * burstLoss) {
            counts.dropped++
            return
        }
        val delay = model.delay + model.jitter * uniform(words[2], words[3])
        if (delay > 0.0) counts.delayed++
        channel.send(export, from.sentAt, from.sentTime + delay)
    }

    /** Advances a link's state for the next message. Returns whether the new state is bad. */
    private fun isBad(id: Int, tick: Long, to: Int, channel: Channel): Boolean {
        draw(id, tick, to, BURST_PURPOSE)
        val number = uniform(words[0], words[1])
        val isBad = when (channel.burst) {
            Burst.UNKNOWN -> number < model.burstShare
            Burst.GOOD -> number < model.burstStartProbability
            Burst.BAD -> number >= model.burstEndProbability
        }
        channel.burst = if (isBad) Burst.BAD else Burst.GOOD
        return isBad
    }

    /** Fills [words] with random numbers of the message of [tick] from the node [id] to the node [to]. */
    private fun draw(id: Int, tick: Long, to: Int, purpose: Int) {
        words[0] = tick.toInt()
        words[1] = id
        words[2] = to
        words[3] = purpose
        Philox.block(words, seed.toInt(), (seed ushr 32).toInt())
    }

    /** Receives the messages due on [channel], and drops an expired one. */
    fun advance(channel: Channel) {
        channel.receiveDue(clock.time + tolerance, model.retention)
        if (channel.expire(clock.time - tolerance)) counts.expired++
    }

    private fun uniform(high: Int, low: Int): Double =
        ((high.toLong() shl 32 or (low.toLong() and 0xFFFF_FFFFL)) ushr 11) * (1.0 / (1L shl 53))

    private companion object {
        /** Purposes of the random streams, see `docs/determinism.md`. */
        const val PURPOSE = 4
        const val BURST_PURPOSE = 5
        const val TOLERANCE = 1e-3
    }
}
