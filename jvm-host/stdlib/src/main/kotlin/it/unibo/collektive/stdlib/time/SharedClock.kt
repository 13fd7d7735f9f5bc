@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.time

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.stdlib.util.aligned
import kotlin.time.Duration
import kotlin.time.Instant

/**
 * Returns the time of a monotonic clock that all devices of a connected component share.
 *
 * The clock starts at [Instant.DISTANT_PAST], independently of the devices' own clocks. In each round, a device advances its last value
 * by the time since its last round. If a neighbour has sent a greater value, the device adopts that value.
 *
 * Once links have stopped changing for as many rounds as the component's diameter, clocks differ by no more than the age of the messages
 * between them. The function is not self-stabilising: one clock that is set too far ahead advances all others for ever.
 *
 * @param localTime this device's own clock. Only differences between its values matter.
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
 * Returns the time left until [timeToWait] has passed on the [sharedClock].
 *
 * The first wait begins when this device first calls the function, and the next one begins when a wait ends. The result is zero or
 * negative only in the round in which a wait ends.
 */
public fun Aggregate<*>.sharedTimeLeftTo(now: Instant, timeToWait: Duration): Duration = aligned("sharedTimeLeftTo") {
    val clock = sharedClock(now)
    evolving(clock) { start ->
        val left = start + timeToWait - clock
        (if (left.isPositive()) start else clock).yielding { left }
    }
}
