@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.accumulation

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.dataSharingMethod
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import it.unibo.collektive.stdlib.util.Maybe
import it.unibo.collektive.stdlib.util.aligned

/**
 * Collects [local] values downhill along [potential]: each device's result is its own value with those of all devices above it on a
 * spanning tree; at the bottom (a sink) that is everybody uphill of it.
 *
 * Single-path collection (Beal and Viroli's "C" block): a device sends what it collected to its parent alone, the least entry by
 * [selectParent] ([findParent] tells about ties), and nothing where it is its own parent. Self-stabilising: once values,
 * links and potential stay as they are, results are right after as many rounds of every device as the tree is deep. While the
 * potential changes, values may be missing or count twice.
 *
 * @param local this device's value.
 * @param potential falls towards the sinks, for example their distance.
 * @param selectParent the least entry by it is the parent; parents must not form a circle.
 * @param accumulateData adds a child's collection to what is there; children come in ascending order of their ids.
 */
public inline fun <reified ID : Any, reified T, reified P : Comparable<P>> Aggregate<ID>.convergeCast(
    local: T,
    potential: Field<ID, P>,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
    noinline accumulateData: (T, T) -> T,
): T = collect(local, findParent(potential, selectParent), dataSharingMethod<Maybe<T>>(), accumulateData)

/** [convergeCast] along this device's [potential] and its neighbours' as they were in their last round. */
public inline fun <reified ID : Any, reified T, reified P : Comparable<P>> Aggregate<ID>.convergeCast(
    local: T,
    potential: P,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
    noinline accumulateData: (T, T) -> T,
): T = convergeCast(local, potentialField(potential, dataSharingMethod<P>()), selectParent, accumulateData)

/** [convergeCast] to the nearest [sink] in hops; stabilises after `hopDistanceTo` has. Devices that reach none keep to themselves. */
public inline fun <reified ID : Any, reified T> Aggregate<ID>.convergeCast(
    local: T,
    sink: Boolean,
    noinline accumulateData: (T, T) -> T,
): T = convergeCast(local, hopDistanceTo(sink), accumulateData = accumulateData)

@PublishedApi
internal fun <ID : Any, P> Aggregate<ID>.potentialField(potential: P, sharing: DataSharingMethod<P>): Field<ID, P> =
    aligned("potential") { neighboring(potential, sharing) }

@PublishedApi
internal fun <ID : Any, T> Aggregate<ID>.collect(
    local: T,
    parent: ID,
    sharing: DataSharingMethod<Maybe<T>>,
    accumulateData: (T, T) -> T,
): T = aligned("convergeCast") {
    exchanging<Maybe<T>, T>(Maybe.None, sharing) { received ->
        var collected = local
        for (neighbor in received.neighbors.list) {
            val value = neighbor.value
            if (value is Maybe.Some) collected = accumulateData(collected, value.value)
        }
        val some = Maybe.Some(collected)
        received.map<Maybe<T>> { if (it.id == parent && parent != localId) some else Maybe.None }.yielding { collected }
    }
}
