package org.collektive.runtime

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.Inbox

/** Runs a [DeviceRuntime.round] of a DSL [program] without sensors, for tests and small networks. */
@Suppress("UNCHECKED_CAST")
public fun <R> DeviceRuntime.round(inbox: Inbox, program: Aggregate<Int>.() -> R): R =
    round(inbox, { aggregate, _ -> (aggregate as Aggregate<Int>).program() }, null) as R
