@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.Aggregate.Companion.dataSharingMethod
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.stdlib.util.Reducer
import it.unibo.collektive.stdlib.util.aligned

/**
 * Merges the values that devices had in their first rounds into one: flooding.
 *
 * Converges to the reduction over the connected component after as many rounds as its diameter. It is **not** self-stabilising: a merged
 * value remains, even when its origin changes its value or leaves. Use [gossip] where values must be forgotten.
 *
 * @param value this device's value in the first round; later ones are ignored.
 * @param reducer merges two values. Must be associative, commutative and idempotent, as a maximum or a union is, because a value can
 *   arrive more than once.
 */
public inline fun <ID : Any, reified V> Aggregate<ID>.nonStabilizingGossip(value: V, noinline reducer: Reducer<V>): V =
    nonStabilizingGossip(value, dataSharingMethod<V>(), reducer)

/**
 * Whether [condition] held in the first round of a device whose messages have reached this one, directly or through others. Once `true`,
 * it stays `true`. Later rounds call [condition] but ignore its result; to watch for an event, see [isHappeningAnywhere].
 */
public fun <ID : Any> Aggregate<ID>.everHappened(condition: () -> Boolean): Boolean = nonStabilizingGossip(condition()) { a, b -> a || b }

@PublishedApi
internal fun <ID : Any, V> Aggregate<ID>.nonStabilizingGossip(value: V, sharing: DataSharingMethod<V>, reducer: Reducer<V>): V =
    aligned("nonStabilizingGossip") {
        exchanging(value, sharing) { received ->
            var merged = received.local.value
            for (neighbor in received.neighbors.list) merged = reducer(merged, neighbor.value)
            received.mapToConstant(merged).yielding { merged }
        }
    }
