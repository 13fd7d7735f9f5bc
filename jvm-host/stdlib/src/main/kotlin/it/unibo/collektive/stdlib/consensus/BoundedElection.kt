@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.consensus

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.Aggregate.Companion.dataSharingMethod
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.stdlib.util.Reducer
import it.unibo.collektive.stdlib.util.aligned
import it.unibo.collektive.stdlib.util.forEachNeighborWith
import it.unibo.collektive.stdlib.util.hops
import it.unibo.collektive.stdlib.util.nonOverflowingPlus

/**
 * Elects a leader at most [bound] away and returns its id.
 *
 * This is sparse leader election (the "S" block). The algorithm is the bounded election of "Self-stabilising Priority-Based Multi-Leader
 * Election and Network Partitioning" (Pianini, Casadei and Viroli, ACSOS 2022).
 *
 * Each device starts with its own candidacy. It passes on the best candidacy that it receives within the bound, together with the
 * distance travelled. It ignores its own candidacy when a neighbour returns it.
 *
 * The function is self-stabilising. Once strengths, links and metric stop changing, the strongest device leads all devices within the
 * bound. Of the remaining devices, the strongest leads those within the bound that it reaches through remaining devices, and so on. Each
 * of these levels takes up to 2 * bound / (least metric) rounds of every device, because the distance of a stale candidacy grows by the
 * metric in each round until it exceeds the bound. If the metric between two neighbours is 0, stale candidacies never disappear.
 *
 * If candidates are equally strong, the nearest one wins, and then the one received first.
 *
 * @param strength this device's strength. The greatest strength wins.
 * @param bound the greatest distance between a device and its leader.
 * @param metric the distances to the neighbours.
 * @param bottom the distance of a device to itself.
 * @param accumulateDistance adds the distance to a neighbour to the neighbour's distance from its leader.
 * @param selectBest returns the better of two candidacies, or the first if they are equally good.
 */
public inline fun <reified ID : Any, reified D : Comparable<D>, reified S : Comparable<S>> Aggregate<ID>.boundedElection(
    strength: S,
    bound: D,
    metric: Field<ID, D>,
    bottom: D,
    noinline accumulateDistance: (D, D) -> D,
    noinline selectBest: Reducer<Candidacy<ID, D, S>> = { a, b -> maxOf(a, b) },
): ID = elect(
    Candidacy(localId, bottom, strength),
    bound,
    metric,
    dataSharingMethod<Candidacy<ID, D, S>>(),
    accumulateDistance,
    selectBest,
)

/** Runs [boundedElection] with distances of 0.0 or greater. */
public inline fun <reified ID : Any, reified S : Comparable<S>> Aggregate<ID>.boundedElection(
    strength: S,
    bound: Double,
    metric: Field<ID, Double>,
    noinline selectBest: Reducer<Candidacy<ID, Double, S>> = { a, b -> maxOf(a, b) },
): ID = boundedElection(strength, bound, metric, 0.0, Double::plus, selectBest)

/** Runs [boundedElection] with distances of 0 or greater, which are counted in hops by default. */
public inline fun <reified ID : Any, reified S : Comparable<S>> Aggregate<ID>.boundedElection(
    strength: S,
    bound: Int,
    metric: Field<ID, Int> = hops(),
    noinline selectBest: Reducer<Candidacy<ID, Int, S>> = { a, b -> maxOf(a, b) },
): ID = boundedElection(strength, bound, metric, 0, Int::nonOverflowingPlus, selectBest)

/** Runs [boundedElection] in such a way that the greatest id wins. */
public inline fun <reified ID : Comparable<ID>, reified D : Comparable<D>> Aggregate<ID>.boundedElection(
    bound: D,
    metric: Field<ID, D>,
    bottom: D,
    noinline accumulateDistance: (D, D) -> D,
    noinline selectBest: Reducer<Candidacy<ID, D, ID>> = { a, b -> maxOf(a, b) },
): ID = boundedElection(localId, bound, metric, bottom, accumulateDistance, selectBest)

/** Runs [boundedElection] with distances of 0.0 or greater. The greatest id wins. */
public inline fun <reified ID : Comparable<ID>> Aggregate<ID>.boundedElection(
    bound: Double,
    metric: Field<ID, Double>,
    noinline selectBest: Reducer<Candidacy<ID, Double, ID>> = { a, b -> maxOf(a, b) },
): ID = boundedElection(localId, bound, metric, selectBest)

/** Runs [boundedElection] with distances of 0 or greater, which are counted in hops by default. The greatest id wins. */
public inline fun <reified ID : Comparable<ID>> Aggregate<ID>.boundedElection(
    bound: Int,
    metric: Field<ID, Int> = hops(),
    noinline selectBest: Reducer<Candidacy<ID, Int, ID>> = { a, b -> maxOf(a, b) },
): ID = boundedElection(localId, bound, metric, selectBest)

@PublishedApi
internal fun <ID : Any, S : Comparable<S>, D : Comparable<D>> Aggregate<ID>.elect(
    own: Candidacy<ID, D, S>,
    bound: D,
    metric: Field<ID, D>,
    sharing: DataSharingMethod<Candidacy<ID, D, S>>,
    accumulateDistance: (D, D) -> D,
    selectBest: Reducer<Candidacy<ID, D, S>>,
): ID = aligned("boundedElection") {
    exchanging(own, sharing) { received ->
        var best = own
        received.forEachNeighborWith(metric) { _, offer, toNeighbor ->
            if (offer.candidate != localId) {
                val distance = accumulateDistance(offer.distance, toNeighbor)
                if (distance <= bound) best = selectBest(best, Candidacy(offer.candidate, distance, offer.strength))
            }
        }
        received.mapToConstant(best).yielding { best.candidate }
    }
}
