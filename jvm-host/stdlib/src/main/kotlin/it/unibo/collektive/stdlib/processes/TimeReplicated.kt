@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.processes

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.stdlib.time.localDeltaTime
import it.unibo.collektive.stdlib.util.aligned
import kotlinx.serialization.Serializable
import kotlin.time.Duration
import kotlin.time.Instant

/**
 * Runs several overlapping replicas of [process] and returns the result of the oldest. A process that never forgets, such as
 * `nonStabilizingGossip`, then follows changes, because each replica ends after [timeToSpawn] * [maxReplicas] and its state with it.
 *
 * This is time replication (Pianini, Beal and Viroli, "Improving gossip dynamics through overlapping replicates", COORDINATION 2016).
 * The connected component agrees on the number of the youngest replica; a device that has seen that number for [timeToSpawn] starts the
 * next. Once inputs and links stop changing, the result no longer depends on earlier ones after [timeToSpawn] * [maxReplicas] plus
 * the time that a number takes to cross the component. [process] must settle within [timeToSpawn] * ([maxReplicas] - 1).
 *
 * @param currentTime this device's clock; only differences matter.
 * @param maxReplicas the number of replicas that run at the same time, 1 or greater.
 * @param timeToSpawn the time between the starts of two replicas; positive.
 * @throws IllegalArgumentException when [maxReplicas] or [timeToSpawn] is out of range.
 */
public fun <ID : Any, T> Aggregate<ID>.timeReplicated(currentTime: Instant, maxReplicas: Int, timeToSpawn: Duration, process: () -> T): T {
    require(maxReplicas >= 1) { "maxReplicas is $maxReplicas; one run at least is needed" }
    require(timeToSpawn.isPositive()) { "timeToSpawn is $timeToSpawn; it must be positive" }
    return aligned("timeReplicated") {
        val youngest = youngestRun(localDeltaTime(currentTime), timeToSpawn)
        val oldest = maxOf(0, youngest - maxReplicas + 1)
        val result = alignedOn(oldest, process)
        for (run in oldest + 1..youngest) alignedOn(run, process)
        result
    }
}

/** The number of the youngest replica in the component. */
private fun <ID : Any> Aggregate<ID>.youngestRun(passed: Duration, timeToSpawn: Duration): Long = share(Run(0, Duration.ZERO)) { seen ->
    val mine = seen.local.value
    var known = Run(mine.number, mine.age + passed)
    for (neighbor in seen.neighbors.list) {
        if (neighbor.value.number > known.number) known = Run(neighbor.value.number, Duration.ZERO)
    }
    if (known.age >= timeToSpawn) Run(known.number + 1, Duration.ZERO) else known
}.number

/** A replica's [number], and the [age]: time since this device first saw it. */
@Serializable
private data class Run(val number: Long, val age: Duration)
