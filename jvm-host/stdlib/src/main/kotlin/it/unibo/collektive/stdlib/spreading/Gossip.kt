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
import it.unibo.collektive.stdlib.util.Reducer
import it.unibo.collektive.stdlib.util.aligned
import kotlinx.serialization.Serializable

/**
 * The best of all devices' [local] values, where [reducer] chooses the better of two.
 *
 * Gossip over self-avoiding paths: a value carries the devices that it came through, so that one whose origin changed or left cannot
 * circle and goes away; equally good values keep the shorter path. Self-stabilising: once values and links stay as they are, every
 * device has the best value of its connected component after as many rounds of every device as a path without repetition can have
 * hops, plus the component's diameter.
 *
 * @param local this device's value.
 * @param maxDiameter the most hops that a value travels. With a limit, a value may be hidden from devices near it by a better one that
 *   ends on the way.
 * @param reducer returns the better of its arguments, whatever their order; like a maximum.
 * @throws IllegalStateException when [reducer] returns something else: merged values never leave again, which is
 *   [nonStabilizingGossip].
 */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.gossip(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    noinline reducer: Reducer<V>,
): V = gossip(local, maxDiameter, dataSharingMethod<GossipValue<ID, V>>(), { _, value -> value }, reducer)

/** The greatest of all devices' [local] values, by [gossip]. */
public inline fun <reified ID : Any, reified V : Comparable<V>> Aggregate<ID>.gossipMax(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> maxOf(a, b) }

/** The least of all devices' [local] values, by [gossip]. */
public inline fun <reified ID : Any, reified V : Comparable<V>> Aggregate<ID>.gossipMin(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> minOf(a, b) }

/** The one of all devices' [local] values for which [selector] gives the greatest result, by [gossip]. */
public inline fun <reified ID : Any, reified V, C : Comparable<C>> Aggregate<ID>.gossipMaxBy(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    crossinline selector: (V) -> C,
): V = gossip(local, maxDiameter) { a, b -> if (selector(b) > selector(a)) b else a }

/** The one of all devices' [local] values for which [selector] gives the least result, by [gossip]. */
public inline fun <reified ID : Any, reified V, C : Comparable<C>> Aggregate<ID>.gossipMinBy(
    local: V,
    maxDiameter: Int = Int.MAX_VALUE,
    crossinline selector: (V) -> C,
): V = gossip(local, maxDiameter) { a, b -> if (selector(b) < selector(a)) b else a }

/** The greatest of all devices' [local] values in the order of [comparator], by [gossip]. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.gossipMaxWith(
    local: V,
    comparator: Comparator<in V>,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> if (comparator.compare(b, a) > 0) b else a }

/** The least of all devices' [local] values in the order of [comparator], by [gossip]. */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.gossipMinWith(
    local: V,
    comparator: Comparator<in V>,
    maxDiameter: Int = Int.MAX_VALUE,
): V = gossip(local, maxDiameter) { a, b -> if (comparator.compare(b, a) < 0) b else a }

/** Whether [condition] holds on any device of the connected component now; stabilises like [gossip], also when it holds no more. */
public inline fun <reified ID : Any> Aggregate<ID>.isHappeningAnywhere(condition: () -> Boolean): Boolean =
    gossip(condition()) { a, b -> a || b }

/** A [value] of [gossip] and the devices that it came through. */
@Serializable
@PublishedApi
internal data class GossipValue<ID : Any, V>(val value: V, val path: HopPath<ID>)

/** [gossip] whose values change on the way: [advance] gives a neighbour's value as it arrives here. */
@PublishedApi
internal fun <ID : Any, V> Aggregate<ID>.gossip(
    local: V,
    maxDiameter: Int,
    sharing: DataSharingMethod<GossipValue<ID, V>>,
    advance: (neighbor: ID, value: V) -> V,
    reducer: Reducer<V>,
): V = aligned("gossip") {
    val mine = GossipValue(local, HopPath.empty<ID>())
    exchanging(mine, sharing) { received ->
        val best = best(received, mine, maxDiameter, advance, reducer)
        received.mapToConstant(best).yielding { best.value }
    }
}

private fun <ID : Any, V> best(
    received: Field<ID, GossipValue<ID, V>>,
    mine: GossipValue<ID, V>,
    maxDiameter: Int,
    advance: (ID, V) -> V,
    reducer: Reducer<V>,
): GossipValue<ID, V> {
    val myself = received.context.localId
    var best = mine.value
    var from: GossipValue<ID, V>? = null
    var through = myself
    for ((id, offer) in received.neighbors.list) {
        if (offer.path.size >= maxDiameter || myself in offer.path) continue
        val value = advance(id, offer.value)
        val better = reducer(best, value)
        val keeps = better == best
        check(keeps || better == value) {
            "gossip's reducer made $better of $best and $value; it must return one of them (nonStabilizingGossip merges values)"
        }
        val shorter = value == best && from.let { it != null && offer.path.size < it.path.size }
        if (keeps && !shorter) continue
        best = value
        from = offer
        through = id
    }
    val offer = from ?: return mine
    val former = received.local.value
    return if (former.value == best && former.path.extends(offer.path, through)) former else GossipValue(best, offer.path + through)
}
