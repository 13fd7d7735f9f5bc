@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.time

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.stdlib.util.aligned
import kotlin.time.Duration
import kotlin.time.Instant

/** Returns the time since this device's last round by its own clock, which is zero in the first round and after the clock was set back. */
public fun Aggregate<*>.localDeltaTime(now: Instant): Duration = aligned("localDeltaTime") {
    evolving(now) { last -> now.yielding { (now - last).coerceAtLeast(Duration.ZERO) } }
}
