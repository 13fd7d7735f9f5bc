@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.stdlib.util.hops
import it.unibo.collektive.stdlib.util.nonOverflowingPlus

/**
 * Runs one [gradientCast] for each of [sources], and returns the data that arrives on this device by source.
 *
 * The value of a source that this device cannot reach is [local]. Each gradient cast stabilises independently, among the devices that
 * list its source.
 *
 * @param sources the ids of the sources. Repeated ids count once. Data of a source passes only through devices that list it.
 * @param local the data of this device if it is a source, and the result for sources that it cannot reach.
 */
public inline fun <reified ID : Any, reified V, reified D : Comparable<D>> Aggregate<ID>.multiGradientCast(
    sources: Iterable<ID>,
    local: V,
    bottom: D,
    top: D,
    metric: Field<ID, D>,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateData: (fromSource: D, toNeighbor: D, data: V) -> V = { _, _, data -> data },
    noinline accumulateDistance: (D, D) -> D,
): Map<ID, V> {
    val results = LinkedHashMap<ID, V>()
    for (source in sources.toSet()) {
        results[source] = alignedOn(source) {
            gradientCast(source == localId, local, bottom, top, metric, maxDiameter, accumulateData, accumulateDistance)
        }
    }
    return results
}

/** Runs [multiGradientCast] with distances in `0.0..POSITIVE_INFINITY`. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.multiGradientCast(
    sources: Iterable<ID>,
    local: V,
    metric: Field<ID, Double>,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateData: (fromSource: Double, toNeighbor: Double, data: V) -> V = { _, _, data -> data },
): Map<ID, V> = multiGradientCast(sources, local, 0.0, Double.POSITIVE_INFINITY, metric, maxDiameter, accumulateData, Double::plus)

/** Runs [multiGradientCast] with distances in `0..Int.MAX_VALUE`, which are counted in hops by default. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.multiIntGradientCast(
    sources: Iterable<ID>,
    local: V,
    metric: Field<ID, Int> = hops(),
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateData: (fromSource: Int, toNeighbor: Int, data: V) -> V = { _, _, data -> data },
): Map<ID, V> = multiGradientCast(sources, local, 0, Int.MAX_VALUE, metric, maxDiameter, accumulateData, Int::nonOverflowingPlus)
