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
 * Collects the [local] values downhill along [potential] on a spanning tree. Each device's result combines its own value with those of
 * its descendants in the tree; at a sink, these are all devices uphill.
 *
 * This is single-path collection (Beal and Viroli's "C" block): a device sends what it collected only to its parent, which is the
 * least entry by [selectParent]; see [findParent] for ties. A device that is its own parent sends nothing.
 *
 * Self-stabilising: once values, links and potential stop changing, results are correct after as many rounds of every device as the
 * tree is deep. While the potential changes, values may be missing or counted twice.
 *
 * @param local this device's value.
 * @param potential decreases towards the sinks, for example the distance to the nearest sink.
 * @param selectParent orders the entries; the least one is the parent. Parents must not form a cycle.
 * @param accumulateData combines the value collected so far with a child's. Children come in ascending order of their ids.
 */
public inline fun <reified ID : Any, reified T, reified P : Comparable<P>> Aggregate<ID>.convergeCast(
    local: T,
    potential: Field<ID, P>,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
    noinline accumulateData: (T, T) -> T,
): T = collect(local, findParent(potential, selectParent), dataSharingMethod<Maybe<T>>(), accumulateData)

/** [convergeCast] along this device's [potential] and the potentials of its neighbours' last rounds. */
public inline fun <reified ID : Any, reified T, reified P : Comparable<P>> Aggregate<ID>.convergeCast(
    local: T,
    potential: P,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
    noinline accumulateData: (T, T) -> T,
): T = convergeCast(local, potentialField(potential, dataSharingMethod<P>()), selectParent, accumulateData)

/** [convergeCast] to the nearest [sink] in hops. Stabilises after `hopDistanceTo` does. A device that reaches no sink sends nothing. */
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

/** The field to send. [value] is boxed once by this call, not again for each neighbour. */
private fun <ID : Any, T> Field<ID, *>.toParent(parent: ID, value: T, none: T): Field<ID, T> = map { if (it.id == parent) value else none }
