@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.processes

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.stdlib.time.localDeltaTime
import it.unibo.collektive.stdlib.util.aligned
import kotlin.time.Duration
import kotlin.time.Instant
import kotlinx.serialization.Serializable

/**
 * The result of the oldest of several overlapping runs of [process]: makes one that never forgets (like `nonStabilizingGossip`) follow
 * changes, since each run ends after [timeToSpawn] times [maxReplicas] and takes what it learnt with it.
 *
 * Time replication (Pianini, Beal and Viroli, "Improving gossip dynamics through overlapping replicates", COORDINATION 2016). The
 * connected component agrees on the number of the youngest run; whoever has known it for [timeToSpawn] starts the next. Once inputs
 * and links stay as they are, the result forgets what was before after [timeToSpawn] times [maxReplicas], and the time that the
 * numbers take through the component. [process] must settle within [timeToSpawn] times [maxReplicas] - 1.
 *
 * @param currentTime this device's clock; only its differences count.
 * @param maxReplicas the most runs at one time, 1 or greater.
 * @param timeToSpawn the time between two starts; positive.
 */
public fun <ID : Any, T> Aggregate<ID>.timeReplicated(
    currentTime: Instant,
    maxReplicas: Int,
    timeToSpawn: Duration,
    process: () -> T,
): T {
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

/** The number of the youngest run that the component knows. */
private fun <ID : Any> Aggregate<ID>.youngestRun(passed: Duration, timeToSpawn: Duration): Long =
    share(Run(0, Duration.ZERO)) { seen ->
        val mine = seen.local.value
        var known = Run(mine.number, mine.age + passed)
        for (neighbor in seen.neighbors.list) {
            if (neighbor.value.number > known.number) known = Run(neighbor.value.number, Duration.ZERO)
        }
        if (known.age >= timeToSpawn) Run(known.number + 1, Duration.ZERO) else known
    }.number

/** A run's [number], and the [age] since this device knows it. */
@Serializable
private data class Run(val number: Long, val age: Duration)
