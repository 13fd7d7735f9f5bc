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
 * Brings the data of the nearest source to every device with the distributed Bellman-Ford algorithm.
 *
 * Each device chooses the neighbour with the least sum of the neighbour's distance and the distance to that neighbour. This is the
 * cheapest gradient cast, because its messages contain no paths. Use it if sources and links do not disappear. Otherwise use
 * [gradientCast].
 *
 * When a source or a link disappears, the devices that relied on it begin to rely on each other. Their distances then rise only by the
 * metric of a few links per round. This is known as "count to infinity" or the "rising value" problem. For example, two devices that are
 * 0.1 apart take ten rounds to rise by 1. If no source remains, the distances rise for ever.
 *
 * The function is self-stabilising as long as a source remains. Once sources, links, data and metric stop changing, distances that are
 * too small are correct after (greatest distance / least metric) rounds. Distances that are too great are correct after as many rounds
 * as the longest of the shortest paths has hops.
 *
 * @param source whether this device is a source.
 * @param local the data of a source. On a device that no source reaches, the result is the data of a neighbour, or [local] if the device
 *   has no neighbours.
 * @param bottom the distance of a source to itself, and the lower bound of [metric].
 * @param top infinity: the distance of a device that no source has reached, and the upper bound of [metric].
 * @param accumulateData computes the data on this device from the neighbour's distance to the source, the distance to the neighbour and
 *   the neighbour's data.
 * @param accumulateDistance adds the distance to a neighbour to that neighbour's distance from the source. The sum is coerced to
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

/** Runs [bellmanFordGradientCast] with distances in `0.0..POSITIVE_INFINITY`. */
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

/** Returns the distance and the data that arrive from the nearest neighbour, or `null` without neighbours. */
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
