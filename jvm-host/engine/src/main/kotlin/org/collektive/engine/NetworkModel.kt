package org.collektive.engine

/**
 * What happens to messages between sending and receiving; times in simulated seconds. The default is ideal: nothing is lost, and a
 * message can be read until the next one replaces it.
 *
 * A message is lost with the probability `loss + lossPerMetre * length + lossPerAttenuation * attenuation` of its link, at most 1. It
 * arrives [delay] seconds after its tick and up to [jitter] more; one that arrives after a later one is of no use.
 *
 * @property loss 0..1.
 * @property lossPerMetre 0 or greater.
 * @property lossPerAttenuation 0 or greater.
 * @property delay 0 or greater.
 * @property jitter 0 or greater; evenly spread.
 * @property retention how long a link holds a message that arrived, greater than 0.
 */
public class NetworkModel(
    public val loss: Double = 0.0,
    public val lossPerMetre: Double = 0.0,
    public val lossPerAttenuation: Double = 0.0,
    public val delay: Double = 0.0,
    public val jitter: Double = 0.0,
    public val retention: Double = Double.POSITIVE_INFINITY,
) {
    init {
        require(loss in 0.0..1.0) { "the network's loss must be 0..1, but is $loss" }
        requireAmount("loss per metre", lossPerMetre)
        requireAmount("loss per attenuation", lossPerAttenuation)
        requireAmount("delay", delay)
        requireAmount("jitter", jitter)
        require(retention > 0.0) { "the network's retention must be greater than 0, but is $retention" }
    }

    /** Whether every message arrives at once and stays. */
    public val isIdeal: Boolean =
        loss == 0.0 && lossPerMetre == 0.0 && lossPerAttenuation == 0.0 && delay == 0.0 && jitter == 0.0 && retention.isInfinite()

    private fun requireAmount(name: String, value: Double) {
        require(value >= 0.0 && value.isFinite()) { "the network's $name must be finite and 0 or greater, but is $value" }
    }
}

/** What the network did in one tick. */
public class NetworkCounts {
    /** Messages that were put on links, one for each link. */
    public var sent: Long = 0
        internal set

    /** Those of [sent] that were lost. */
    public var dropped: Long = 0
        internal set

    /** Those of [sent] that arrive later than they would in an ideal network. */
    public var delayed: Long = 0
        internal set

    /** Messages that links held and whose retention ended. */
    public var expired: Long = 0
        internal set

    internal fun clear() {
        sent = 0
        dropped = 0
        delayed = 0
        expired = 0
    }

    internal fun add(other: NetworkCounts) {
        sent += other.sent
        dropped += other.dropped
        delayed += other.delayed
        expired += other.expired
    }
}
