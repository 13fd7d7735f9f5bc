@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.consensus

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.stdlib.util.Reducer
import it.unibo.collektive.stdlib.util.hops

/**
 * Returns the id of the strongest device of the connected component.
 *
 * If several devices are equally strong, the nearest by [metric] wins, so each of them leads its own region.
 *
 * This is [boundedElection] without a bound, and it is not self-stabilising: the candidacy of a leader that has left circulates among
 * the remaining devices. If leaders may leave, use [boundedElection].
 *
 * @param strength this device's strength. The greatest strength wins.
 * @param metric the distances to the neighbours.
 * @param selectBest returns the better of two candidacies, or the first if they are equally good.
 */
public inline fun <reified ID : Any, reified S : Comparable<S>> Aggregate<ID>.globalElection(
    strength: S,
    metric: Field<ID, Int> = hops(),
    noinline selectBest: Reducer<Candidacy<ID, Int, S>> = { a, b -> maxOf(a, b) },
): ID = boundedElection(strength, Int.MAX_VALUE, metric, selectBest)

/** Returns the greatest id of the connected component, elected with [globalElection]. */
public inline fun <reified ID : Comparable<ID>> Aggregate<ID>.globalElection(): ID = globalElection(localId)
