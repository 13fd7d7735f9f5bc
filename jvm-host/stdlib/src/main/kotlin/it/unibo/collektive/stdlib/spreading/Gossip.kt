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
import it.unibo.collektive.stdlib.util.Reducer
import it.unibo.collektive.stdlib.util.aligned
import it.unibo.collektive.stdlib.util.isSameAs
import kotlinx.serialization.Serializable

/**
 * Returns the best of all devices' [local] values, where [reducer] chooses the better of two values.
 *
 * This is gossip over self-avoiding paths: each value carries the list of the devices that it passed. A device ignores offers by the
 * rules of [gradientCast], with distances in hops, so a value disappears after its origin has changed it or has left. The device combines
 * its own value with each of the remaining offers, beginning with the shortest paths. It keeps a result that is better than the best one
 * so far.
 *
 * The function is self-stabilising if [reducer] returns one of its arguments. Once values and links stop changing, every device has the
 * best value of its connected component after as many rounds of every device as the longest simple path has hops, plus the diameter of
 * the component.
 *
 * If [reducer] merges its arguments, as a union or a sum does, the result may lack values and may never stabilise, because each offer
 * may already contain other values. To merge values, use [nonStabilizingGossip].
 *
 * @param local this device's value.
 * @param maxDiameter the greatest number of hops of a neighbour's value. Values therefore travel one hop farther. With a limit, a device
 *   may miss a value within the limit, because a better value displaces it on the way but does not reach the device.
 * @param reducer returns the better of its arguments, as a maximum does, or either of them if they are equally good. The default returns
 *   the first, so every device keeps its own value.
 */
public inline fun <reified ID : Comparable<ID>, reified V> Aggregate<ID>.gossip(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline reducer: Reducer<V> = { first, _ -> first },
): V = gossip(local, maxDiameter, dataSharingMethod<GossipValue<ID, V>>(), reducer)

/** Returns the maximum of all devices' [local] values, spread by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V : Comparable<V>> Aggregate<ID>.gossipMax(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> maxOf(a, b) }

/** Returns the minimum of all devices' [local] values, spread by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V : Comparable<V>> Aggregate<ID>.gossipMin(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> minOf(a, b) }

/** Returns the [local] value for which [selector] returns the greatest result on all devices, spread by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V, C : Comparable<C>> Aggregate<ID>.gossipMaxBy(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    crossinline selector: (V) -> C,
): V = gossip(local, maxDiameter) { a, b -> if (selector(b) > selector(a)) b else a }

/** Returns the [local] value for which [selector] returns the least result on all devices, spread by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V, C : Comparable<C>> Aggregate<ID>.gossipMinBy(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    crossinline selector: (V) -> C,
): V = gossip(local, maxDiameter) { a, b -> if (selector(b) < selector(a)) b else a }

/** Returns the greatest of all devices' [local] values by [comparator], spread by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V> Aggregate<ID>.gossipMaxWith(
    local: V,
    comparator: Comparator<V>,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> if (comparator.compare(b, a) > 0) b else a }

/** Returns the least of all devices' [local] values by [comparator], spread by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V> Aggregate<ID>.gossipMinWith(
    local: V,
    comparator: Comparator<V>,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> if (comparator.compare(b, a) < 0) b else a }

/**
 * Returns whether [condition] currently holds on any device of the connected component.
 *
 * It stabilises like [gossip], and returns to `false` when the condition no longer holds.
 */
public inline fun <reified ID : Comparable<ID>> Aggregate<ID>.isHappeningAnywhere(condition: () -> Boolean): Boolean =
    gossip(condition()) { a, b -> a || b }

/** A [value] that [gossip] spreads, and the [path] of the devices that it passed. */
@Serializable
@PublishedApi
internal data class GossipValue<ID : Any, V>(val value: V, val path: HopPath<ID>)

@PublishedApi
internal fun <ID : Any, V> Aggregate<ID>.gossip(
    local: V,
    maxDiameter: Int,
    sharing: DataSharingMethod<GossipValue<ID, V>>,
    reducer: Reducer<V>,
): V = aligned("gossip") {
    val mine = GossipValue(local, HopPath.empty<ID>())
    exchanging(mine, sharing) { received ->
        val best = best(received, mine, maxDiameter, reducer)
        received.mapToConstant(best).yielding { best.value }
    }
}

private fun <ID : Any, V> best(
    received: Field<ID, GossipValue<ID, V>>,
    mine: GossipValue<ID, V>,
    maxDiameter: Int,
    reducer: Reducer<V>,
): GossipValue<ID, V> {
    var best = mine.value
    var from = -1
    var hops = received.shortestPath(0)
    while (hops in 0..maxDiameter) {
        for (index in 0 until received.neighborCount) {
            val offer = received.neighborValue(index)
            if (offer.path.size != hops) continue
            val value = reducer(mine.value, offer.value)
            // Check coherence last, because it is costly and matters only for an offer that improves the result.
            if (value == best || reducer(best, value) == best || !received.isCoherent(index)) continue
            best = value
            from = index
        }
        hops = received.shortestPath(hops + 1)
    }
    if (from < 0) return mine
    val id = received.neighborId(from)
    val path = received.neighborValue(from).path
    val former = received.local.value
    return if (former.value.isSameAs(best) && former.path.extends(path, id)) former else GossipValue(best, path + id)
}

/** Returns the length of the shortest received path with at least [least] hops, or -1 if no path is that long. */
private fun <ID : Any, V> Field<ID, GossipValue<ID, V>>.shortestPath(least: Int): Int {
    var shortest = -1
    for (index in 0 until neighborCount) {
        val size = neighborValue(index).path.size
        if (size >= least && (shortest < 0 || size < shortest)) shortest = size
    }
    return shortest
}

/** Returns whether the offer at [index] is usable, and orders common hops like every usable offer with a shorter path. */
private fun <ID : Any, V> Field<ID, GossipValue<ID, V>>.isCoherent(index: Int): Boolean {
    if (!isUsable(index)) return false
    val path = neighborValue(index).path
    for (other in 0 until neighborCount) {
        val shorter = neighborValue(other).path
        val isShorter = shorter.size < path.size && !shorter.hasSameHopOrder(neighborId(other), path, neighborId(index))
        if (isShorter && isUsable(other)) return false
    }
    return true
}

/** Returns whether the offer at [index] passed neither through this device nor through a neighbour with a shorter path. */
private fun <ID : Any, V> Field<ID, GossipValue<ID, V>>.isUsable(index: Int): Boolean {
    val path = neighborValue(index).path
    if (context.localId in path) return false
    for (other in 0 until neighborCount) {
        if (neighborValue(other).path.size < path.size && neighborId(other) in path) return false
    }
    return true
}
