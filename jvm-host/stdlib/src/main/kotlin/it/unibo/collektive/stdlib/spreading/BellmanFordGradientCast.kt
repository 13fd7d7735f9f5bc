@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.Aggregate.Companion.dataSharingMethod
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.stdlib.util.aligned
import it.unibo.collektive.stdlib.util.forEachNeighborWith

/**
 * Brings the data of the nearest source to every device by the distributed Bellman-Ford algorithm: each device minimises a neighbour's
 * distance plus the distance to that neighbour. This is the cheapest gradient cast, because its messages contain no paths. Use it where
 * sources and links do not vanish; otherwise use [gradientCast].
 *
 * When a source or a link vanishes, the devices that relied on it rely on each other, and their distances rise only by the metric of a
 * few links per round ("count to infinity", the "rising value" problem). Two devices 0.1 apart take ten rounds to rise by 1. If no
 * source remains, the distances rise forever.
 *
 * While a source remains, it is self-stabilising: once sources, links, data and metric stop changing, distances that are too small are
 * correct after (greatest distance / least metric) rounds, and those that are too great after as many rounds as the longest shortest
 * path has hops.
 *
 * @param source whether this device is a source.
 * @param local the data of a source. Where no source is reached, the result is the data of a neighbour, or [local] without neighbours.
 * @param bottom the distance of a source to itself, and the lower bound of [metric].
 * @param top infinity: the distance of a device before it is reached, and the upper bound of [metric].
 * @param accumulateData computes the data on arrival from the neighbour's distance to the source, the distance to the neighbour and the
 *   neighbour's data.
 * @param accumulateDistance adds a distance to a neighbour to the neighbour's distance from the source. The sum is coerced to
 *   [bottom]..[top].
 * @param metric the distances to the neighbours, coerced to [bottom]..[top].
 * @throws IllegalStateException when an aligned neighbour has no value in [metric], or when a sum is less than one of its parts.
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
    source,
    local,
    bottom,
    top,
    dataSharingMethod<Pair<D, V>>(),
    accumulateData,
    accumulateDistance,
    metric,
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
    sharing: DataSharingMethod<Pair<D, V>>,
    accumulateData: (D, D, V) -> V,
    accumulateDistance: (D, D) -> D,
    metric: Field<ID, D>,
): V = aligned("bellmanFordGradientCast") {
    exchanging(top to local, sharing) { received ->
        val result = if (source) {
            bottom to local
        } else {
            nearest(received, bottom, top, metric, accumulateData, accumulateDistance)
                ?: (top to local)
        }
        received.mapToConstant(result).yielding { result.second }
    }
}

/** The nearest neighbour's distance and data as they arrive here; `null` without neighbours. */
private fun <ID : Any, V, D : Comparable<D>> nearest(
    received: Field<ID, Pair<D, V>>,
    bottom: D,
    top: D,
    metric: Field<ID, D>,
    accumulateData: (D, D, V) -> V,
    accumulateDistance: (D, D) -> D,
): Pair<D, V>? {
    var least: D? = null
    var from: Pair<D, V>? = null
    var step: D? = null
    received.forEachNeighborWith(metric) { _, offer, length ->
        val toNeighbor = length.coerceIn(bottom, top)
        val distance = limitedSum(offer.first, toNeighbor, accumulateDistance(offer.first, toNeighbor), bottom, top)
        val best = least
        if (best == null || distance < best) {
            least = distance
            from = offer
            step = toNeighbor
        }
    }
    val offer = from ?: return null
    val distance = least ?: return null
    val toNeighbor = step ?: return null
    return distance to accumulateData(offer.first, toNeighbor, offer.second)
}
