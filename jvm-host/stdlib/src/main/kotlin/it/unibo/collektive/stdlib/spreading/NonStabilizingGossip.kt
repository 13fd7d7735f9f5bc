@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.dataSharingMethod
import it.unibo.collektive.stdlib.util.Reducer
import it.unibo.collektive.stdlib.util.aligned

/**
 * All values that devices ever had, reduced to one: flooding.
 *
 * Converges to the reduction over the connected component after as many rounds as its diameter, but is **not** self-stabilising:
 * what was once merged stays, also when its origin changes its value or leaves. [gossip] forgets.
 *
 * @param value this device's value.
 * @param reducer merges two values; associative, commutative and idempotent (like a maximum or a union), as a value arrives many times.
 */
public inline fun <reified ID : Any, reified V> Aggregate<ID>.nonStabilizingGossip(
    value: V,
    noinline reducer: Reducer<V>,
): V = nonStabilizingGossip(value, dataSharingMethod<V>(), reducer)

/** Whether [condition] ever held on a device from which word came here; once `true`, always `true`. */
public inline fun <reified ID : Any> Aggregate<ID>.everHappened(condition: () -> Boolean): Boolean =
    nonStabilizingGossip(condition()) { a, b -> a || b }

@PublishedApi
internal fun <ID : Any, V> Aggregate<ID>.nonStabilizingGossip(
    value: V,
    sharing: DataSharingMethod<V>,
    reducer: Reducer<V>,
): V = aligned("nonStabilizingGossip") {
    exchanging(value, sharing) { received ->
        var merged = reducer(received.local.value, value)
        for (neighbor in received.neighbors.list) merged = reducer(merged, neighbor.value)
        received.mapToConstant(merged).yielding { merged }
    }
}
