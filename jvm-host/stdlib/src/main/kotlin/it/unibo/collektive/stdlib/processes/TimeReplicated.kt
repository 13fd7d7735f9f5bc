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

/** The number of a replica that [timeReplicated] runs. */
public typealias ReplicaID = ULong

/**
 * Runs several overlapping replicas of [process] and returns the result of the oldest one.
 *
 * Use this function for a process that never discards values, such as `nonStabilizingGossip`. The result then follows changes, because each
 * replica and its state end after at most [timeToSpawn] * [maxReplicas]. [process] must settle within
 * [timeToSpawn] * ([maxReplicas] - 1) if the waits of all devices end together.
 *
 * Waits end together if all devices call this function for the first time in the same round and always run at the same times. Otherwise,
 * for example under the asynchronous schedule or if nodes join later, each of the n devices of the connected component starts replicas.
 * Replicas then end up to n times as early, and results may lack values unless [process] settles within [timeToSpawn] * k, where k is
 * ([maxReplicas] - 1) / n without its fraction.
 *
 * This is time replication (Pianini, Beal and Viroli, "Improving gossip dynamics through overlapping replicates", COORDINATION 2016).
 * A device takes part in the youngest replica that it or a neighbour knows. When the wait of [sharedTimeLeftTo] for [timeToSpawn] is
 * over, the device starts the next replica in its following round. It does not do so if it has just started or adopted a replica, or if
 * it receives a younger one. Replicas therefore start at least two rounds apart. A device that joins begins with the youngest replica.
 *
 * Once inputs and links stop changing, the result no longer depends on earlier inputs after [timeToSpawn] * [maxReplicas], plus the
 * time that the number of a new replica takes to cross the connected component.
 *
 * @param currentTime this device's clock. Only differences between its values matter.
 * @param maxReplicas the number of replicas that run at the same time, which must be 1 or greater.
 * @param timeToSpawn the time that a device waits between its starts of two replicas, which must be positive.
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

/**
 * Returns the youngest replica that this device or a neighbour knows.
 *
 * If that is this device's own replica, and the wait for the next one was over in the last round, starts the next one and returns it.
 */
private fun Aggregate<*>.youngestReplica(isOver: Boolean): ReplicaID = aligned("youngestReplica") {
    val replica = share(Replica(0uL, false)) { seen ->
        val own = seen.local.value
        val known = seen.all.list.maxOf { it.value.id }
        val youngest = if (own.isOver && own.id == known) known + 1uL else known
        Replica(youngest, isOver && own.id == youngest)
    }
    replica.id
}

/** The youngest replica in which a device takes part, and whether the device's wait for the next replica [isOver]. */
@Serializable
private class Replica(val id: ReplicaID, val isOver: Boolean)
