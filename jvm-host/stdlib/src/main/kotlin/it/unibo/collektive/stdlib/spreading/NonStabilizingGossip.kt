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
 * Merges the values that all devices had in their first rounds into one by flooding.
 *
 * After as many rounds as the diameter of the connected component, the result contains the values of all its devices. The function is
 * **not** self-stabilising: a merged value remains even after its origin has changed it or has left. If values must be discarded, use
 * [gossip].
 *
 * @param value this device's value in its first round. Later values are ignored.
 * @param reducer merges two values. It must be associative, commutative and idempotent, as a maximum or a union is, because a value can
 *   arrive more than once.
 */
public inline fun <ID : Any, reified V> Aggregate<ID>.nonStabilizingGossip(value: V, noinline reducer: Reducer<V>): V =
    nonStabilizingGossip(value, dataSharingMethod<V>(), reducer)

/**
 * Returns whether [condition] held in the first round of any device whose messages have reached this one, directly or through others.
 *
 * Once the result is `true`, it stays `true`. Later rounds call [condition] but ignore its result. To watch for an event, use
 * [isHappeningAnywhere].
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
