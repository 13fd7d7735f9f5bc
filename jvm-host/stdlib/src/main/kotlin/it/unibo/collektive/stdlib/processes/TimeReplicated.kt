@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.processes

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.share
import it.unibo.collektive.stdlib.time.sharedTimeLeftTo
import it.unibo.collektive.stdlib.util.aligned
import kotlinx.serialization.Serializable
import kotlin.time.Duration
import kotlin.time.Instant

/** The number of a replica of [timeReplicated]. */
public typealias ReplicaID = ULong

/**
 * Runs several overlapping replicas of [process] and returns the result of the oldest. A process that never forgets, such as
 * `nonStabilizingGossip`, then follows changes, because each replica and its state end after [timeToSpawn] * [maxReplicas].
 *
 * This is time replication (Pianini, Beal and Viroli, "Improving gossip dynamics through overlapping replicates", COORDINATION 2016).
 * A device takes part in the youngest replica that a neighbour knows. It starts the next one in the round after [sharedTimeLeftTo] of
 * [timeToSpawn] was over, unless it has just started or adopted a replica, or receives a younger one. Replicas therefore start at least
 * two rounds apart. A device that joins begins with the youngest replica. Once inputs and links stop changing, the result no longer
 * depends on earlier ones after [timeToSpawn] * [maxReplicas] plus the time that a number takes to cross the connected component.
 * [process] must settle within [timeToSpawn] * ([maxReplicas] - 1).
 *
 * @param currentTime this device's clock; only differences matter.
 * @param maxReplicas the number of replicas that run at the same time, 1 or greater.
 * @param timeToSpawn the time between the starts of two replicas; positive.
 * @throws IllegalArgumentException when [maxReplicas] or [timeToSpawn] is out of range.
 */
public inline fun <reified T> Aggregate<*>.timeReplicated(
    currentTime: Instant,
    maxReplicas: Int,
    timeToSpawn: Duration,
    noinline process: () -> T,
): T = replicated(currentTime, maxReplicas, timeToSpawn, process)

@PublishedApi
internal fun <T> Aggregate<*>.replicated(currentTime: Instant, maxReplicas: Int, timeToSpawn: Duration, process: () -> T): T {
    require(maxReplicas >= 1) { "maxReplicas is $maxReplicas; it must be at least 1" }
    require(timeToSpawn.isPositive()) { "timeToSpawn is $timeToSpawn; it must be positive" }
    return aligned("timeReplicated") {
        val isOver = !sharedTimeLeftTo(currentTime, timeToSpawn).isPositive()
        val youngest = youngestReplica(isOver)
        val replicas = evolve(emptyList<ReplicaID>()) { if (youngest in it) it else (it + youngest).takeLast(maxReplicas) }
        val oldest = alignedOn(replicas.first(), process)
        for (younger in replicas.drop(1)) alignedOn(younger, process)
        oldest
    }
}

/** The youngest replica that this device or a neighbour knows, or the next one if this device's wait for it was over in its last round. */
private fun Aggregate<*>.youngestReplica(isOver: Boolean): ReplicaID = aligned("youngestReplica") {
    val replica = share(Replica(0uL, false)) { seen ->
        val own = seen.local.value
        val known = seen.all.list.maxOf { it.value.id }
        val youngest = if (own.isOver && own.id == known) known + 1uL else known
        Replica(youngest, isOver && own.id == youngest)
    }
    replica.id
}

/** The youngest replica that a device takes part in, and whether its wait for the next one [isOver]. */
@Serializable
private class Replica(val id: ReplicaID, val isOver: Boolean)
