@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry
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
 * This is gossip over self-avoiding paths: each value carries the devices that it passed. A device ignores a value that passed through
 * it, or through a neighbour whose own value has a shorter path. A value whose origin changed or left therefore cannot circulate and
 * dies out. Values with shorter paths are tried first.
 *
 * Self-stabilising: once values and links stop changing, every device has the best value of its connected component after as many
 * rounds of every device as the longest simple path has hops, plus the component's diameter.
 *
 * @param local this device's value.
 * @param maxDiameter the greatest number of hops of a value, counted at the neighbour: it travels one hop farther. With a limit, a device may miss a value within reach, where a
 *   better value displaces it on the way but does not reach the device itself.
 * @param reducer returns the better of its arguments, as a maximum does; of equally good ones either. By default the first: every device
 *   keeps its own value.
 * @throws IllegalStateException when [reducer] returns neither of its arguments. To merge values, use [nonStabilizingGossip].
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

/** The least of all devices' [local] values, by [gossip]. */
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
    var from: FieldEntry<ID, GossipValue<ID, V>>? = null
    for (offer in freshOffers(received, maxDiameter)) {
        val value = offer.value.value
        val better = reducer(best, value)
        if (better == best) continue
        check(better == value) {
            "gossip's reducer made $better of $best and $value; it must return one of them (nonStabilizingGossip merges values)"
        }
        best = value
        from = offer
    }
    val (id, offer) = from ?: return mine
    val former = received.local.value
    return if (former.value == best && former.path.extends(offer.path, id)) former else GossipValue(best, offer.path + id)
}

/** The offers that neither passed through this device nor through a neighbour with a shorter path; those with the shortest paths first. */
private fun <ID : Any, V> freshOffers(
    received: Field<ID, GossipValue<ID, V>>,
    maxDiameter: Int,
): List<FieldEntry<ID, GossipValue<ID, V>>> {
    val myself = received.context.localId
    val neighbors = received.neighbors.list.toList()
    return neighbors.filter { (_, offer) ->
        val path = offer.path
        path.size <= maxDiameter && myself !in path && neighbors.none { it.value.path.size < path.size && it.id in path }
    }.sortedBy { it.value.path.size }
}
