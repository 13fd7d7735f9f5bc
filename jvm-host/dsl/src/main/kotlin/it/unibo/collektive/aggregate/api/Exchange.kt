@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.aggregate.api

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate.Companion.dataSharingMethod

/**
 * Sends each neighbour a different value and stores one for the next round.
 *
 * [body] receives a field of the values that the aligned neighbours sent to this device. Its local value is the one stored by the previous
 * round, or [initial] in the first round. [body] yields the field to send; the field's local value is stored. A receiver that is not
 * in that field gets the local value.
 */
public inline fun <ID : Any, reified Shared, Return> Aggregate<ID>.exchanging(
    initial: Shared,
    noinline body: YieldingScope<Field<ID, Shared>, Return>,
): Return = exchanging(initial, dataSharingMethod<Shared>(), body)

/** [exchanging] that returns the field that it sends. */
public inline fun <ID : Any, reified Shared> Aggregate<ID>.exchange(
    initial: Shared,
    noinline body: (Field<ID, Shared>) -> Field<ID, Shared>,
): Field<ID, Shared> = exchanging(initial) { received -> body(received).yielding { this } }

/** Like [exchanging], but sends one value to all neighbours: `sharing(0) { seen -> next.yielding { result } }`. */
public inline fun <ID : Any, reified Shared, Return> Aggregate<ID>.sharing(
    initial: Shared,
    noinline body: YieldingContext<Shared, Return>.(Field<ID, Shared>) -> YieldingResult<Shared, Return>,
): Return = exchanging(initial) { received ->
    val (toSend, toReturn) = YieldingContext<Shared, Return>().body(received)
    received.mapToConstant(toSend).yielding { toReturn }
}

/** [sharing] that returns the value that it sends: `share(0) { seen -> seen.all.values.list.max() + 1 }`. */
public inline fun <ID : Any, reified Shared> Aggregate<ID>.share(initial: Shared, noinline body: (Field<ID, Shared>) -> Shared): Shared =
    sharing(initial) { received -> body(received).yielding { this } }
