package org.collektive.engine

/**
 * Models loss, delay and expiry of messages. Times are in simulated seconds. The default is an ideal network: no message is lost, and
 * each stays readable until the next one replaces it.
 *
 * A message is lost with probability `loss + lossPerMetre * length + lossPerAttenuation * attenuation` of its link, at most 1. It arrives
 * [delay] to [delay] + [jitter] seconds after its tick. A message that arrives after a later one is ignored.
 *
 * Losses can come in bursts: each link is in a good or bad state, which may change with each message (Gilbert-Elliott model: E. O. Elliott,
 * "Estimates of error rates for codes on burst-noise channels", Bell System Technical Journal 42(5), 1963). In the bad state, a message
 * that would otherwise arrive is lost with probability [burstLoss].
 *
 * @property loss base probability of loss, 0..1.
 * @property lossPerMetre additional probability per metre of the link, 0 or greater.
 * @property lossPerAttenuation additional probability per unit of attenuation, 0 or greater.
 * @property delay minimum delay in seconds, 0 or greater.
 * @property jitter maximum additional delay in seconds, 0 or greater; uniformly distributed.
 * @property retention seconds for which a received message stays readable, greater than 0.
 * @property burstShare long-run share of a link's messages that are sent in the bad state, 0 or greater and less than 1.
 * @property burstLength mean number of successive messages in the bad state, at least 1 and at least `burstShare / (1 - burstShare)`.
 * @property burstLoss probability of loss in the bad state, 0..1.
 * @throws IllegalArgumentException when a value is out of range.
 */
public class NetworkModel(
    public val loss: Double = 0.0,
    public val lossPerMetre: Double = 0.0,
    public val lossPerAttenuation: Double = 0.0,
    public val delay: Double = 0.0,
    public val jitter: Double = 0.0,
    public val retention: Double = Double.POSITIVE_INFINITY,
    public val burstShare: Double = 0.0,
    public val burstLength: Double = 1.0,
    public val burstLoss: Double = 1.0,
) {
    init {
        require(loss in 0.0..1.0) { "the network's loss must be 0..1, but is $loss" }
        requireAmount("loss per metre", lossPerMetre)
        requireAmount("loss per attenuation", lossPerAttenuation)
        requireAmount("delay", delay)
        requireAmount("jitter", jitter)
        require(burstShare >= 0.0 && burstShare < 1.0) {
            "the network's burst share must be at least 0 and less than 1, but is $burstShare"
        }
        // The tolerance is for shares such as 0.8, because 0.8 / (1 - 0.8) is 4.000000000000001.
        require(burstLength >= 1.0 && burstLength * (1.0 + 1e-9) >= burstShare / (1.0 - burstShare) && burstLength.isFinite()) {
            "the network's burst length must be finite, at least 1 and at least burst share / (1 - burst share), but is $burstLength"
        }
        require(burstLoss in 0.0..1.0) { "the network's burst loss must be 0..1, but is $burstLoss" }
        require(retention > 0.0) { "the network's retention must be greater than 0, but is $retention" }
    }

    /** Whether every message arrives immediately and stays readable. */
    public val isIdeal: Boolean = loss == 0.0 && lossPerMetre == 0.0 && lossPerAttenuation == 0.0 && delay == 0.0 && jitter == 0.0 &&
        retention.isInfinite() && burstShare == 0.0

    /** Probability that a link leaves the bad state with each message. */
    internal val burstEndProbability = 1.0 / burstLength

    /** Probability that a link enters the bad state with each message. */
    internal val burstStartProbability = burstEndProbability * burstShare / (1.0 - burstShare)

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
