@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.Aggregate.Companion.dataSharingMethod
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.stdlib.util.HopPath
import it.unibo.collektive.stdlib.util.PathValue
import it.unibo.collektive.stdlib.util.aligned
import it.unibo.collektive.stdlib.util.forEachNeighborWith
import it.unibo.collektive.stdlib.util.hops
import it.unibo.collektive.stdlib.util.isSameAs
import it.unibo.collektive.stdlib.util.nonOverflowingPlus

/**
 * Brings the data of the nearest source to every device along a shortest path.
 *
 * On a device that cannot reach a source, the result is [local].
 *
 * This is a gradient cast (Beal and Viroli's "G" block) over self-avoiding paths, as in path-vector routing: each offer to a neighbour
 * carries the list of the devices that it passed. A device ignores these offers:
 * - an offer whose path contains the device itself;
 * - an offer whose path contains a neighbour that is nearer than the offer, or that offers nothing;
 * - an offer that has common hops in a different order with an offer over fewer hops, or over as many hops at a different distance.
 *
 * The device selects the nearest of the remaining offers and sends the result to its neighbours. The neighbour that made this offer gets
 * the next best one instead. If offers are equally near, the neighbour with the lower id wins.
 *
 * The function is self-stabilising. Once sources, links, data and metric stop changing, stale offers disappear after as many rounds of
 * every device as the longest simple path has hops (at most the number of devices, or [maxDiameter]). All values come from shortest paths
 * after as many further rounds as these paths have hops. Stale offers cannot circulate. However small the metric is, values therefore do
 * not creep up when a source or a link disappears, unlike those of [bellmanFordGradientCast] (the "rising value" problem).
 *
 * @param source whether this device is a source.
 * @param local the data of a source, and the result of a device that cannot reach a source. A round is cheaper if unchanged data is the
 *   same object, a number or a text.
 * @param bottom the distance of a source to itself, and the lower bound of [metric].
 * @param top infinity: the upper bound of [metric].
 * @param metric the distances to the neighbours, coerced to [bottom]..[top]. Paths are shortest only if distances exceed [bottom].
 * @param maxDiameter the greatest number of hops of a neighbour's offer. Data therefore travels one hop farther.
 * @param accumulateData computes the data on this device from the neighbour's distance to the source, the distance to the neighbour and
 *   the neighbour's data. It is called only for offers that are selected, and must depend on its arguments alone.
 * @param accumulateDistance adds the distance to a neighbour to that neighbour's distance from the source. The sum is coerced to
 *   [bottom]..[top].
 * @throws IllegalStateException when an aligned neighbour has no value in [metric], or when a sum is less than one of its parts.
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
    .run(source, local, dataSharingMethod<PathValue<ID, V, D>?>())

/** Runs [gradientCast] with distances in `0.0..POSITIVE_INFINITY`. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.gradientCast(
    source: Boolean,
    local: V,
    metric: Field<ID, Double>,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateData: (fromSource: Double, toNeighbor: Double, data: V) -> V = { _, _, data -> data },
    noinline accumulateDistance: (Double, Double) -> Double = Double::plus,
): V = gradientCast(source, local, 0.0, Double.POSITIVE_INFINITY, metric, maxDiameter, accumulateData, accumulateDistance)

/** Runs [gradientCast] with distances in `0..Int.MAX_VALUE`, where `Int.MAX_VALUE` stands for infinity. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.intGradientCast(
    source: Boolean,
    local: V,
    metric: Field<ID, Int>,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateData: (fromSource: Int, toNeighbor: Int, data: V) -> V = { _, _, data -> data },
    noinline accumulateDistance: (Int, Int) -> Int = Int::nonOverflowingPlus,
): V = gradientCast(source, local, 0, Int.MAX_VALUE, metric, maxDiameter, accumulateData, accumulateDistance)

/** Runs [gradientCast] with distances in hops. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.hopGradientCast(
    source: Boolean,
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline accumulateData: (fromSource: Int, toNeighbor: Int, data: V) -> V = { _, _, data -> data },
): V = intGradientCast(source, local, hops(), maxDiameter, accumulateData)

/**
 * Returns the [sum] of a neighbour's [distance] and the [step] to that neighbour, limited to [bottom]..[top].
 *
 * @throws IllegalStateException when the result is less than [distance] or [step], for example after an overflow.
 */
internal fun <D : Comparable<D>> limitedSum(distance: D, step: D, sum: D, bottom: D, top: D): D {
    val limited = sum.coerceIn(bottom, top)
    check(limited >= distance && limited >= step) {
        "accumulateDistance violates the triangle inequality: $sum is the sum of $distance and $step, but less than one of them"
    }
    return limited
}

/** The computation of one gradient cast in one round. */
@PublishedApi
internal class GradientCast<ID : Any, V, D : Comparable<D>>(
    private val bottom: D,
    private val top: D,
    private val metric: Field<ID, D>,
    private val maxDiameter: Int,
    private val accumulateData: (D, D, V) -> V,
    private val accumulateDistance: (D, D) -> D,
) {
    fun run(source: Boolean, local: V, sharing: DataSharingMethod<PathValue<ID, V, D>?>): V = metric.context.aligned("gradientCast") {
        metric.context.exchanging<PathValue<ID, V, D>?, V>(null, sharing) { received ->
            if (source) {
                received.mapToConstant(atSource(local, received.local.value)).yielding { local }
            } else {
                spread(received).yielding { this.local.value.let { if (it == null) local else it.data } }
            }
        }
    }

    /** Returns the offer of a source, which is [former] itself if nothing changed. */
    private fun atSource(local: V, former: PathValue<ID, V, D>?): PathValue<ID, V, D> =
        former?.takeIf { it.length == 0 && it.distance.isSameAs(bottom) && it.data.isSameAs(local) }
            ?: PathValue(bottom, local, HopPath.empty<ID>())

    /** Returns the field to send. Its local value is this device's result. */
    private fun spread(received: Field<ID, PathValue<ID, V, D>?>): Field<ID, PathValue<ID, V, D>?> {
        val choice = received.context.aligned("choice") {
            received.context.evolve<Choice<ID, V, D>?>(null) { former -> choose(received, former) }
        }
        val best = choice?.best ?: return received.mapToConstant(null)
        val taken = take(best, received.local.value)
        return received.map { if (it.id == best.id) choice.returned else taken }
    }

    /** Chooses among the [received] offers. If they are unchanged, reuses the [former] choice and compares no paths. */
    private fun choose(received: Field<ID, PathValue<ID, V, D>?>, former: Choice<ID, V, D>?): Choice<ID, V, D> {
        val settled = former?.takeIf { it.isAmong(received) }
        val offers = if (settled != null) settled.offers else offers(received)
        val myself = received.context.localId
        val best = if (settled != null) settled.best else nextCoherent(offers, myself)
        val second = if (settled != null) settled.second else best?.let { nextCoherent(offers, myself) }
        val returned = second?.let { take(it, former?.returned) }
        return settled?.takeIf { it.returned === returned } ?: Choice(offers, maxDiameter, best, second, returned)
    }

    /**
     * Returns whether this choice was made among the same offers as those [received].
     *
     * A settled network calls this in each round, so it compares values by identity, and creates no [Offer]s. Settled devices of this
     * process send the same object again.
     */
    private fun Choice<ID, V, D>.isAmong(received: Field<ID, PathValue<ID, V, D>?>): Boolean {
        if (maxDiameter != this@GradientCast.maxDiameter || offers.size != received.neighborCount) return false
        var index = 0
        received.forEachNeighborWith(metric) { id, value, distance ->
            val offer = offers[index++]
            val step = distance.coerceIn(bottom, top)
            if (value !== offer.value || id != offer.id) return false
            if (!step.isSameAs(offer.step) || !total(value, step).isSameAs(offer.distance)) return false
        }
        return true
    }

    /** Returns the limited distance from the source of [value] to this device, or [step] if the neighbour offers nothing. */
    private fun total(value: PathValue<ID, V, D>?, step: D): D =
        if (value == null) step else limitedSum(value.distance, step, accumulateDistance(value.distance, step), bottom, top)

    /** Returns the offers of the neighbours, in the field's order. */
    private fun offers(received: Field<ID, PathValue<ID, V, D>?>): List<Offer<ID, V, D>> {
        val offers = ArrayList<Offer<ID, V, D>>(received.neighborCount)
        received.forEachNeighborWith(metric) { id, value, distance ->
            val step = distance.coerceIn(bottom, top)
            offers += Offer(id, step, total(value, step), value)
        }
        return offers
    }

    /** Returns the nearest coherent one of the [offers] that were not considered before, or `null` if none is left. */
    private fun nextCoherent(offers: List<Offer<ID, V, D>>, myself: ID): Offer<ID, V, D>? {
        while (true) {
            var nearest: Offer<ID, V, D>? = null
            for (index in offers.indices) {
                val offer = offers[index]
                if (!offer.considered && (nearest == null || offer < nearest)) nearest = offer
            }
            if (nearest == null) return null
            nearest.considered = true
            if (nearest.isCoherent(offers, myself)) return nearest
        }
    }

    /** Returns whether this offer is usable and no usable offer contradicts it. */
    private fun Offer<ID, V, D>.isCoherent(offers: List<Offer<ID, V, D>>, myself: ID): Boolean {
        if (!isUsable(offers, myself)) return false
        for (index in offers.indices) {
            val other = offers[index]
            if (other !== this && other.contradicts(this) && other.isUsable(offers, myself)) return false
        }
        return true
    }

    private fun Offer<ID, V, D>.isUsable(offers: List<Offer<ID, V, D>>, myself: ID): Boolean =
        usable ?: passesNoneOf(offers, myself).also { usable = it }

    private fun Offer<ID, V, D>.passesNoneOf(offers: List<Offer<ID, V, D>>, myself: ID): Boolean {
        val path = path
        if (path == null || path.size > maxDiameter || myself in path) return false
        for (index in offers.indices) {
            val other = offers[index]
            if (other.id in path && (other.value == null || other < this)) return false
        }
        return true
    }

    /**
     * Returns the value of [offer] on this device.
     *
     * Returns [former] itself if nothing changed, and its path if only the data changed, so a settled network allocates no paths.
     */
    private fun take(offer: Offer<ID, V, D>, former: PathValue<ID, V, D>?): PathValue<ID, V, D> {
        val value = checkNotNull(offer.value)
        val data = accumulateData(value.distance, offer.step, value.data)
        val known = former?.takeIf { it.path.extends(value.path, offer.id) }
        return known?.takeIf { it.distance.isSameAs(offer.distance) && it.data.isSameAs(data) }
            ?: PathValue(offer.distance, data, known?.path ?: (value.path + offer.id))
    }
}

/**
 * The choice of a device in a round among [offers] of at most [maxDiameter] hops.
 *
 * The device and its neighbours get the [best] offer. Only the neighbour that made it gets [returned], which results from the [second]
 * best offer.
 */
private class Choice<ID : Any, V, D : Comparable<D>>(
    val offers: List<Offer<ID, V, D>>,
    val maxDiameter: Int,
    val best: Offer<ID, V, D>?,
    val second: Offer<ID, V, D>?,
    val returned: PathValue<ID, V, D>?,
)

/**
 * The offer of the neighbour [id], which is [step] away.
 *
 * [value] is `null` if the neighbour offers nothing. [distance] is the limited distance to this device from the source, or from the
 * neighbour if it offers nothing.
 */
private class Offer<ID : Any, V, D : Comparable<D>>(val id: ID, val step: D, val distance: D, val value: PathValue<ID, V, D>?) :
    Comparable<Offer<ID, V, D>> {
    val path: HopPath<ID>? get() = value?.path

    var considered: Boolean = false

    /** Whether the offer passed neither this device nor a neighbour that refutes it, or `null` before the first query. */
    var usable: Boolean? = null

    /**
     * Returns whether this offer and [other] have common hops in different orders, and this offer has fewer hops, or as many at a different
     * distance.
     */
    fun contradicts(other: Offer<ID, V, D>): Boolean {
        val mine = path ?: return false
        val others = other.path ?: return false
        return (mine.size < others.size || mine.size == others.size && compareTo(other) != 0) && !mine.hasSameHopOrder(id, others, other.id)
    }

    override fun compareTo(other: Offer<ID, V, D>): Int = distance.compareTo(other.distance)
}
