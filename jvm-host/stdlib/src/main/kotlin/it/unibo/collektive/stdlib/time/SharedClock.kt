@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.time

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.stdlib.util.aligned
import kotlin.time.Duration
import kotlin.time.Instant

/**
 * A monotonic clock that all devices of a connected component share: the greatest clock received, or this device's last value advanced
 * by the time since its last round if that is greater.
 *
 * Once links stop changing, clocks differ by no more than the age of the messages between them, after as many rounds as the
 * component's diameter. Not self-stabilising: one clock that is set too far ahead advances all others for ever.
 *
 * It starts at [Instant.DISTANT_PAST], independently of the devices' own clocks.
 *
 * @param localTime this device's own clock; only differences matter.
 */
public fun Aggregate<*>.sharedClock(localTime: Instant): Instant = aligned("sharedClock") {
    val passed = localDeltaTime(localTime)
    share(Instant.DISTANT_PAST) { seen ->
        var clock = seen.local.value + passed
        for (neighbor in seen.neighbors.list) clock = maxOf(clock, neighbor.value)
        clock
    }
}

/**
 * The time left until [timeToWait] has passed on the [sharedClock] since this device first called the function, or since the last wait
 * ended. Waits repeat. The result is zero or negative only in the round in which a wait ends.
 */
public fun Aggregate<*>.sharedTimeLeftTo(now: Instant, timeToWait: Duration): Duration = aligned("sharedTimeLeftTo") {
    val clock = sharedClock(now)
    evolving(clock) { start ->
        val left = start + timeToWait - clock
        (if (left.isPositive()) start else clock).yielding { left }
    }
}
