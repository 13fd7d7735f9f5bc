@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.consensus

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.dataSharingMethod
import it.unibo.collektive.stdlib.spreading.GossipValue
import it.unibo.collektive.stdlib.spreading.gossip
import it.unibo.collektive.stdlib.util.hops
import it.unibo.collektive.stdlib.util.nonOverflowingPlus

/**
 * The id of the strongest device of the connected component; of several equally strong ones, the nearest by [metric], so that each
 * leads its own region.
 *
 * Candidacies spread by [gossip] and stabilise like it: a leader that leaves or weakens is replaced, although no bound limits distances.
 *
 * @param strength this device's strength; the greatest wins.
 * @param metric the distances to the neighbours.
 */
public inline fun <reified ID : Any, reified S : Comparable<S>> Aggregate<ID>.globalElection(
    strength: S,
    metric: Field<ID, Int> = hops(),
): ID = gossip(
    Candidacy(localId, 0, strength),
    Int.MAX_VALUE,
    dataSharingMethod<GossipValue<ID, Candidacy<ID, Int, S>>>(),
    { neighbor, offer -> offer.copy(distance = offer.distance.nonOverflowingPlus(metric[neighbor])) },
    { a, b -> maxOf(a, b) },
).candidate

/** The greatest id of the connected component, by [globalElection]. */
public inline fun <reified ID : Comparable<ID>> Aggregate<ID>.globalElection(): ID = globalElection(localId)
