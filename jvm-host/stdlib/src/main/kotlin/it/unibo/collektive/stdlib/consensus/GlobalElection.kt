@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.consensus

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.stdlib.util.Reducer
import it.unibo.collektive.stdlib.util.hops

/**
 * The id of the strongest device of the connected component; of several equally strong ones, the nearest by [metric], so that each
 * leads its own region.
 *
 * This is [boundedElection] without a bound, so it is not self-stabilising: the candidacy of a leader that left circulates between the
 * devices that remain. Where leaders leave, bound the distance.
 *
 * @param strength this device's strength; the greatest wins.
 * @param metric the distances to the neighbours.
 * @param selectBest returns the better of two candidacies, the first on ties.
 */
public inline fun <reified ID : Any, reified S : Comparable<S>> Aggregate<ID>.globalElection(
    strength: S,
    metric: Field<ID, Int> = hops(),
    noinline selectBest: Reducer<Candidacy<ID, Int, S>> = { a, b -> maxOf(a, b) },
): ID = boundedElection(strength, Int.MAX_VALUE, metric, selectBest)

/** The greatest id of the connected component, by [globalElection]. */
public inline fun <reified ID : Comparable<ID>> Aggregate<ID>.globalElection(): ID = globalElection(localId)
