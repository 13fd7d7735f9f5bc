@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.accumulation

import arrow.core.Some
import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.Aggregate.Companion.dataSharingMethod
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import it.unibo.collektive.stdlib.util.Maybe
import it.unibo.collektive.stdlib.util.aligned

/**
 * Collects the [local] values of all devices towards the sinks, which are the devices where [potential] has a minimum.
 *
 * The values flow along a spanning tree. A device's result combines its own value with those of its descendants in the tree. At a sink,
 * the descendants are all devices uphill.
 *
 * This is single-path collection (Beal and Viroli's "C" block). A device sends the collected value only to its parent, which is the
 * device with the least entry by [selectParent]. [findParent] describes ties. A device that is its own parent sends nothing.
 *
 * The function is self-stabilising: once values, links and potential stop changing, the results are correct after as many rounds of
 * every device as the tree has levels. While the potential changes, values may be missing or counted twice.
 *
 * @param local this device's value.
 * @param potential a value that decreases towards the sinks, for example the distance to the nearest sink.
 * @param selectParent the order of the entries. The least entry is the parent's. Parents must not form a cycle.
 * @param accumulateData combines the value collected so far with a child's value. Children come in ascending order of their ids.
 */
public inline fun <reified ID : Any, reified T, reified P : Comparable<P>> Aggregate<ID>.convergeCast(
    local: T,
    potential: Field<ID, P>,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
    noinline accumulateData: (T, T) -> T,
): T = collect(local, findParent(potential, selectParent), dataSharingMethod<Maybe<T>>(), accumulateData)

/** Runs [convergeCast] with this device's [potential] and the potentials that its neighbours had in their last rounds. */
public inline fun <reified ID : Any, reified T, reified P : Comparable<P>> Aggregate<ID>.convergeCast(
    local: T,
    potential: P,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
    noinline accumulateData: (T, T) -> T,
): T = convergeCast(local, potentialField(potential, dataSharingMethod<P>()), selectParent, accumulateData)

/**
 * Runs [convergeCast] towards the nearest [sink] in hops.
 *
 * It stabilises after `hopDistanceTo` has done so, where each device reaches a sink and sinks are not neighbours. Elsewhere it does not,
 * because potentials are equal: neighbours that cannot reach a sink, or are both sinks, choose each other as parents ([findParent]) and
 * count each other's values again in each round.
 */
public inline fun <reified ID : Any, reified T> Aggregate<ID>.convergeCast(
    local: T,
    sink: Boolean,
    noinline accumulateData: (T, T) -> T,
): T = convergeCast(local, hopDistanceTo(sink), accumulateData = accumulateData)

@PublishedApi
internal fun <ID : Any, T> Aggregate<ID>.collect(
    local: T,
    parent: ID,
    sharing: DataSharingMethod<Maybe<T>>,
    accumulateData: (T, T) -> T,
): T = aligned("convergeCast") {
    exchanging<Maybe<T>, T>(Maybe.none, sharing) { received ->
        var collected = local
        for (neighbor in received.neighbors.list) {
            val value = neighbor.value.option
            if (value is Some) collected = accumulateData(collected, value.value)
        }
        if (parent == localId) {
            received.mapToConstant(Maybe.none).yielding { collected }
        } else {
            received.toParent(parent, Maybe.some(collected), Maybe.none).yielding { collected }
        }
    }
}

/** Returns the field to send. As a generic parameter of this function, [value] is boxed once and not for each neighbour. */
private fun <ID : Any, T> Field<ID, *>.toParent(parent: ID, value: T, none: T): Field<ID, T> = map { if (it.id == parent) value else none }
