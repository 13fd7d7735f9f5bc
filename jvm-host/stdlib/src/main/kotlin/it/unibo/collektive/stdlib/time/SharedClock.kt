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
 * @param localTime this device's own clock; after the first round only differences matter.
 */
public fun <ID : Any> Aggregate<ID>.sharedClock(localTime: Instant): Instant = aligned("sharedClock") {
    val passed = localDeltaTime(localTime)
    share(localTime) { seen ->
        var clock = seen.local.value + passed
        for (neighbor in seen.neighbors.list) clock = maxOf(clock, neighbor.value)
        clock
    }
}

/**
 * The time left until [timeToWait] has passed on the [sharedClock], counted from when the first device of the connected component
 * called this function; then zero. Devices that call it later join the same wait. Not self-stabilising, like the clock.
 */
public fun <ID : Any> Aggregate<ID>.sharedTimeLeftTo(now: Instant, timeToWait: Duration): Duration = aligned("sharedTimeLeftTo") {
    val clock = sharedClock(now)
    val start = share(clock) { seen ->
        var start = seen.local.value
        for (neighbor in seen.neighbors.list) start = minOf(start, neighbor.value)
        start
    }
    (start + timeToWait - clock).coerceAtLeast(Duration.ZERO)
}
