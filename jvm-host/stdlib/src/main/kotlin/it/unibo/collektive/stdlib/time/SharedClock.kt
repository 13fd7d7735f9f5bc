@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.time

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.stdlib.util.aligned
import kotlin.time.Duration
import kotlin.time.Instant

/**
 * A clock that never goes back and that all devices of a connected component share: the greatest that is known, moved on by the
 * time since this device's last round.
 *
 * Once links stay as they are, devices differ by no more than the age of the messages between them after as many rounds as the
 * component's diameter. Not self-stabilising: a clock once set too far ahead pulls all others along for ever.
 *
 * @param localTime this device's own clock; only its differences count after the first round.
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
 * The time left until [timeToWait] has passed on the [sharedClock] since the first device of the connected component came here;
 * zero from then on. Devices that come later join the running wait. Not self-stabilising, as the clock.
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
