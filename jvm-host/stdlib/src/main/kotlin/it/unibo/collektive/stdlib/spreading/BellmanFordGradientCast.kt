@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.dataSharingMethod
import it.unibo.collektive.stdlib.util.aligned
import it.unibo.collektive.stdlib.util.forEachNeighborWith

/**
 * Brings the data of the nearest source to every device, by the distributed Bellman-Ford algorithm: each device takes its
 * neighbours' best distance plus the distance to that neighbour. The cheapest gradient cast; messages hold no paths.
 *
 * After a source or a link vanishes, the devices that relied on it count on one another and climb by no more than the metric of a
 * few links each round ("count to infinity", the "raising value" problem): between two devices 0.1 apart it takes ten rounds to climb
 * by 1. Where no source is left the values never come to rest. Otherwise, self-stabilising: once sources, links, data and
 * metric stay as they are, too small values have risen to the true ones after (greatest distance / least metric) rounds, and too
 * great ones have fallen after as many rounds as the longest shortest path has hops. Where sources or links vanish, take [gradientCast].
 *
 * @param source whether this device is a source.
 * @param local what a source offers, and the result without any.
 * @param bottom the distance of a source to itself.
 * @param top infinity: who is that far away from all sources is not reached.
 * @param accumulateData the data as it arrives from a neighbour, given the neighbour's distance from the source, the distance to the
 *   neighbour, and its data.
 * @param accumulateDistance adds a distance to a neighbour to the neighbour's distance from the source.
 * @param metric the distances to the neighbours.
 */
public inline fun <reified ID : Any, reified V, reified D : Comparable<D>> Aggregate<ID>.bellmanFordGradientCast(
    source: Boolean,
    local: V,
    bottom: D,
    top: D,
    noinline accumulateData: (fromSource: D, toNeighbor: D, data: V) -> V = { _, _, data -> data },
    noinline accumulateDistance: (D, D) -> D,
    metric: Field<ID, D>,
): V = bellmanFordGradientCast(
    source, local, bottom, top, dataSharingMethod<Pair<D, V>?>(), accumulateData, accumulateDistance, metric,
)

/** [bellmanFordGradientCast] over distances in `0.0..POSITIVE_INFINITY`. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.bellmanFordGradientCast(
    source: Boolean,
    local: V,
    noinline accumulateData: (fromSource: Double, toNeighbor: Double, data: V) -> V = { _, _, data -> data },
    noinline accumulateDistance: (Double, Double) -> Double = Double::plus,
    metric: Field<ID, Double>,
): V = bellmanFordGradientCast(source, local, 0.0, Double.POSITIVE_INFINITY, accumulateData, accumulateDistance, metric)

@PublishedApi
internal fun <ID : Any, V, D : Comparable<D>> Aggregate<ID>.bellmanFordGradientCast(
    source: Boolean,
    local: V,
    bottom: D,
    top: D,
    sharing: DataSharingMethod<Pair<D, V>?>,
    accumulateData: (D, D, V) -> V,
    accumulateDistance: (D, D) -> D,
    metric: Field<ID, D>,
): V = aligned("bellmanFordGradientCast") {
    exchanging<Pair<D, V>?, V>(null, sharing) { received ->
        val result = if (source) bottom to local else nearest(received, metric, top, accumulateData, accumulateDistance)
        received.mapToConstant(result).yielding { if (result == null) local else result.second }
    }
}

private fun <ID : Any, V, D : Comparable<D>> nearest(
    received: Field<ID, Pair<D, V>?>,
    metric: Field<ID, D>,
    top: D,
    accumulateData: (D, D, V) -> V,
    accumulateDistance: (D, D) -> D,
): Pair<D, V>? {
    var least = top
    var from: Pair<D, V>? = null
    var step: D? = null
    received.forEachNeighborWith(metric) { _, offer, toNeighbor ->
        if (offer != null) {
            val distance = accumulateDistance(offer.first, toNeighbor)
            if (distance < least) {
                least = distance
                from = offer
                step = toNeighbor
            }
        }
    }
    val offer = from ?: return null
    val toNeighbor = step ?: return null
    return least to accumulateData(offer.first, toNeighbor, offer.second)
}
