package org.collektive.engine

/**
 * Models loss, delay and expiry of messages. Times are in simulated seconds. The default is an ideal network: no message is lost, and
 * each stays readable until the next one replaces it.
 *
 * A message is lost with probability `loss + lossPerMetre * length + lossPerAttenuation * attenuation` of its link, at most 1. It arrives
 * [delay] to [delay] + [jitter] seconds after its tick. A message that arrives after a later one is ignored.
 *
 * @property loss base probability of loss, 0..1.
 * @property lossPerMetre additional probability per metre of the link, 0 or greater.
 * @property lossPerAttenuation additional probability per unit of attenuation, 0 or greater.
 * @property delay least delay in seconds, 0 or greater.
 * @property jitter greatest additional delay in seconds, 0 or greater; uniformly distributed.
 * @property retention seconds for which a received message stays readable, greater than 0.
 * @throws IllegalArgumentException when a value is out of range.
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

    /** Whether every message arrives immediately and stays readable. */
    public val isIdeal: Boolean =
        loss == 0.0 && lossPerMetre == 0.0 && lossPerAttenuation == 0.0 && delay == 0.0 && jitter == 0.0 && retention.isInfinite()

    private fun requireAmount(name: String, value: Double) {
        require(value >= 0.0 && value.isFinite()) { "the network's $name must be finite and 0 or greater, but is $value" }
    }
}

/** Counts of the messages of one tick. */
public class NetworkCounts {
    /** Messages sent: one per link and export. */
    public var sent: Long = 0
        internal set

    /** Messages of [sent] that were lost. */
    public var dropped: Long = 0
        internal set

    /** Messages of [sent] that arrive later than in an ideal network. */
    public var delayed: Long = 0
        internal set

    /** Received messages that expired. */
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
