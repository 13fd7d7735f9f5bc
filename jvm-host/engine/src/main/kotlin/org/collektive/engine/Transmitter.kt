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

    /** Sends the last message of [from] on the [channel] of its link to the node [to]. */
    fun send(from: Node, to: Int, length: Float, attenuation: Float, channel: Channel) {
        val export = from.last ?: return
        counts.sent++
        words[0] = from.sentAt.toInt()
        words[1] = from.id
        words[2] = to
        words[3] = PURPOSE
        Philox.block(words, seed.toInt(), (seed ushr 32).toInt())
        val loss = model.loss + model.lossPerMetre * length + model.lossPerAttenuation * attenuation
        if (uniform(words[0], words[1]) < loss) {
            counts.dropped++
            return
        }
        val delay = model.delay + model.jitter * uniform(words[2], words[3])
        if (delay > 0.0) counts.delayed++
        channel.send(export, from.sentAt, from.sentTime + delay)
    }

    /** Receives the messages due on [channel], and drops an expired one. */
    fun advance(channel: Channel) {
        channel.receiveDue(clock.time + tolerance, model.retention)
        if (channel.expire(clock.time - tolerance)) counts.expired++
    }

    private fun uniform(high: Int, low: Int): Double =
        ((high.toLong() shl 32 or (low.toLong() and 0xFFFF_FFFFL)) ushr 11) * (1.0 / (1L shl 53))

    private companion object {
        /** Purpose of the random stream, see `docs/determinism.md`. */
        const val PURPOSE = 4
        const val TOLERANCE = 1e-3
    }
}
