@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.dataSharingMethod
import it.unibo.collektive.stdlib.util.HopPath
import it.unibo.collektive.stdlib.util.PathValue
import it.unibo.collektive.stdlib.util.aligned
import it.unibo.collektive.stdlib.util.forEachNeighborWith
import it.unibo.collektive.stdlib.util.hops
import it.unibo.collektive.stdlib.util.nonOverflowingPlus

/**
 * Brings the data of the nearest source to every device along a shortest path; returns [local] where no source is reached.
 *
 * This is a gradient cast (Beal and Viroli's "G" block) over self-avoiding paths, as in path-vector routing: each offer carries the
 * devices that it passed. A device takes the nearest offer whose path does not contain it and sends the result to its neighbours. To the
 * neighbour whose offer it took it sends the next best one instead, provided that no neighbour on that offer's path is nearer and that
 * the hops common to both paths are in the same order. On ties the neighbour with the lower id wins.
 *
 * Self-stabilising: once sources, links, data and metric stop changing, stale offers are gone after as many rounds of every device as
 * the longest simple path has hops (at most the number of devices, or [maxDiameter]). Values are those of the shortest paths after
 * as many further rounds as these have hops. Stale offers cannot circulate, so values do not creep up when a source vanishes or a link
 * breaks, however small the metric is (the "rising value" problem of [bellmanFordGradientCast]).
 *
 * @param source whether this device is a source.
 * @param local what a source offers, and the result where no source is reached.
 * @param bottom the distance of a source to itself, and the lower bound of [metric].
 * @param top infinity: the upper bound of [metric].
 * @param metric the distances to the neighbours, coerced to [bottom]..[top]. Paths are shortest only if distances exceed [bottom].
 * @param maxDiameter the greatest number of hops that data travels.
 * @param accumulateData computes the data on arrival from the neighbour's distance to the source, the distance to the neighbour and the
 *   neighbour's data. Called only for offers that are taken; must depend on its arguments alone.
 * @param accumulateDistance adds a distance to a neighbour to the neighbour's distance from the source.
 * @throws IllegalStateException when an aligned neighbour has no value in [metric].
 */
public inline fun <reified ID : Any, reified V, reified D : Comparable<D>> Aggregate<ID>.gradientCast(
    source: Boolean,
    local: V,
    bottom: D,
    top: D,
    metric: Field<ID, D>,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateData: (fromSource: D, toNeighbor: D, data: V) -> V = { _, _, data -> data },
    noinline accumulateDistance: (D, D) -> D,
): V = GradientCast(bottom, top, metric, maxDiameter, accumulateData, accumulateDistance)
    .run(source, local, dataSharingMethod<PathValue<ID, D, V>?>())

/** [gradientCast] over distances in `0.0..POSITIVE_INFINITY`. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.gradientCast(
    source: Boolean,
    local: V,
    metric: Field<ID, Double>,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateData: (fromSource: Double, toNeighbor: Double, data: V) -> V = { _, _, data -> data },
    noinline accumulateDistance: (Double, Double) -> Double = Double::plus,
): V = gradientCast(source, local, 0.0, Double.POSITIVE_INFINITY, metric, maxDiameter, accumulateData, accumulateDistance)

/** [gradientCast] over distances in `0..Int.MAX_VALUE`, which stands for infinity. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.intGradientCast(
    source: Boolean,
    local: V,
    metric: Field<ID, Int>,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateData: (fromSource: Int, toNeighbor: Int, data: V) -> V = { _, _, data -> data },
    noinline accumulateDistance: (Int, Int) -> Int = Int::nonOverflowingPlus,
): V = gradientCast(source, local, 0, Int.MAX_VALUE, metric, maxDiameter, accumulateData, accumulateDistance)

/** [gradientCast] over distances in hops. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.hopGradientCast(
    source: Boolean,
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateData: (fromSource: Int, toNeighbor: Int, data: V) -> V = { _, _, data -> data },
): V = intGradientCast(source, local, hops(), maxDiameter, accumulateData)

/** One gradient cast in one round. */
@PublishedApi
internal class GradientCast<ID : Any, V, D : Comparable<D>>(
    private val bottom: D,
    private val top: D,
    private val metric: Field<ID, D>,
    private val maxDiameter: Int,
    private val accumulateData: (D, D, V) -> V,
    private val accumulateDistance: (D, D) -> D,
) {
    fun run(source: Boolean, local: V, sharing: DataSharingMethod<PathValue<ID, D, V>?>): V = metric.context.aligned("gradientCast") {
        metric.context.exchanging<PathValue<ID, D, V>?, V>(null, sharing) { received ->
            if (source) {
                received.mapToConstant(PathValue(bottom, local, HopPath.empty<ID>())).yielding { local }
            } else {
                spread(received).yielding { this.local.value.let { if (it == null) local else it.data } }
            }
        }
    }

    /** The field to send; its local value is this device's result. */
    private fun spread(received: Field<ID, PathValue<ID, D, V>?>): Field<ID, PathValue<ID, D, V>?> {
        val offers = usableOffers(received)
        val best = offers.minOrNull() ?: return received.mapToConstant(null)
        val taken = take(best, received.local.value)
        val other = nextBest(offers, best, taken.path)?.let { take(it, null) }
        return received.map { if (it.id == best.id) other else taken }
    }

    private fun usableOffers(received: Field<ID, PathValue<ID, D, V>?>): List<Offer<ID, V, D>> {
        val myself = received.context.localId
        val offers = ArrayList<Offer<ID, V, D>>(received.neighbors.size)
        received.forEachNeighborWith(metric) { id, value, distance ->
            if (value != null && value.path.size < maxDiameter && myself !in value.path) {
                val step = distance.coerceIn(bottom, top)
                offers += Offer(id, step, accumulateDistance(value.distance, step), value)
            }
        }
        return offers
    }

    /** The nearest offer except [best] that has no nearer neighbour on its path and agrees with the [taken] path. */
    private fun nextBest(offers: List<Offer<ID, V, D>>, best: Offer<ID, V, D>, taken: HopPath<ID>): Offer<ID, V, D>? {
        var found: Offer<ID, V, D>? = null
        for (offer in offers) {
            if (offer === best || found != null && found <= offer) continue
            val path = offer.value.path
            if (offers.none { it < offer && it.id in path } && (path + offer.id).agreesWith(taken)) found = offer
        }
        return found
    }

    /** The value of [offer] on this device. Returns [former] itself if nothing changed, so that a settled network allocates no paths. */
    private fun take(offer: Offer<ID, V, D>, former: PathValue<ID, D, V>?): PathValue<ID, D, V> {
        val value = offer.value
        val data = accumulateData(value.distance, offer.step, value.data)
        return if (
            former != null && former.path.extends(value.path, offer.id) && former.distance == offer.distance && former.data == data
        ) {
            former
        } else {
            PathValue(offer.distance, data, value.path + offer.id)
        }
    }
}

/** The offer [value] of the neighbour [id], which is [step] away; [distance] is from the source to this device. */
private class Offer<ID : Any, V, D : Comparable<D>>(val id: ID, val step: D, val distance: D, val value: PathValue<ID, D, V>) :
    Comparable<Offer<ID, V, D>> {
    override fun compareTo(other: Offer<ID, V, D>): Int = distance.compareTo(other.distance)
}
