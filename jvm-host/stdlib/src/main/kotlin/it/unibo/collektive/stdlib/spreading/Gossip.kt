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
import kotlinx.serialization.Serializable

/**
 * The best of all devices' [local] values: [reducer] chooses the better of two.
 *
 * This is gossip over self-avoiding paths: each value carries the devices that it passed. Offers are filtered as in [gradientCast], with
 * distances in hops, so a value whose origin changed or left cannot circulate and dies out. A device reduces its own value with each
 * offer that is left, those with shorter paths first, and takes the result if it improves the best one so far.
 *
 * Self-stabilising if [reducer] chooses: once values and links stop changing, every device has the best value of its connected component
 * after as many rounds of every device as the longest simple path has hops, plus the component's diameter.
 *
 * With a reducer that merges its arguments, such as a union or a sum, the result need not merge all values and need not stabilise,
 * because each offer arrives with its own history. To merge values, use [nonStabilizingGossip].
 *
 * @param local this device's value.
 * @param maxDiameter the greatest number of hops of a value, counted at the neighbour: it travels one hop farther. With a limit, a device
 *   may miss a value within reach, where a better value displaces it on the way but does not reach the device itself.
 * @param reducer returns the better of its arguments, as a maximum does, or either of equally good ones. By default it returns the first,
 *   so every device keeps its own value.
 */
public inline fun <reified ID : Comparable<ID>, reified V> Aggregate<ID>.gossip(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline reducer: Reducer<V> = { first, _ -> first },
): V = gossip(local, maxDiameter, dataSharingMethod<GossipValue<ID, V>>(), reducer)

/** The greatest of all devices' [local] values, by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V : Comparable<V>> Aggregate<ID>.gossipMax(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> maxOf(a, b) }

/** Returns the minimum of all devices' [local] values, spread by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V : Comparable<V>> Aggregate<ID>.gossipMin(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> minOf(a, b) }

/** The [local] value of all devices for which [selector] returns the greatest result, by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V, C : Comparable<C>> Aggregate<ID>.gossipMaxBy(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    crossinline selector: (V) -> C,
): V = gossip(local, maxDiameter) { a, b -> if (selector(b) > selector(a)) b else a }

/** The [local] value of all devices for which [selector] returns the least result, by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V, C : Comparable<C>> Aggregate<ID>.gossipMinBy(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    crossinline selector: (V) -> C,
): V = gossip(local, maxDiameter) { a, b -> if (selector(b) < selector(a)) b else a }

/** The greatest of all devices' [local] values in the order of [comparator], by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V> Aggregate<ID>.gossipMaxWith(
    local: V,
    comparator: Comparator<V>,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> if (comparator.compare(b, a) > 0) b else a }

/** The least of all devices' [local] values in the order of [comparator], by [gossip]. */
public inline fun <reified ID : Comparable<ID>, reified V> Aggregate<ID>.gossipMinWith(
    local: V,
    comparator: Comparator<V>,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> if (comparator.compare(b, a) < 0) b else a }

/** Whether [condition] holds on any device of the connected component now. Stabilises like [gossip], also back to `false`. */
public inline fun <reified ID : Comparable<ID>> Aggregate<ID>.isHappeningAnywhere(condition: () -> Boolean): Boolean =
    gossip(condition()) { a, b -> a || b }

/** A [value] of [gossip] and the [path] of devices that it passed. */
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
            // The filters are costly and matter only if the offer would be taken.
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
    return if (former.value == best && former.path.extends(path, id)) former else GossipValue(best, path + id)
}

/** The least number of hops, at least [least], among the received paths, or -1 if no path was received. */
private fun <ID : Any, V> Field<ID, GossipValue<ID, V>>.shortestPath(least: Int): Int {
    var shortest = -1
    for (index in 0 until neighborCount) {
        val size = neighborValue(index).path.size
        if (size >= least && (shortest < 0 || size < shortest)) shortest = size
    }
    return shortest
}

/** Whether the offer at [index] is usable and no usable offer over fewer hops shares hops with it in another order. */
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

/** Whether the offer at [index] passed neither through this device nor through a neighbour with a shorter path. */
private fun <ID : Any, V> Field<ID, GossipValue<ID, V>>.isUsable(index: Int): Boolean {
    val path = neighborValue(index).path
    if (context.localId in path) return false
    for (other in 0 until neighborCount) {
        if (neighborValue(other).path.size < path.size && neighborId(other) in path) return false
    }
    return true
}
