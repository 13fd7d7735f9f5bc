@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.aggregate.api

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate.Companion.dataSharingMethod

/** Sends [local] to all neighbours. Returns the field of the values of the aligned neighbours, with [local] as its local value. */
public inline fun <ID : Any, reified Shared> Aggregate<ID>.neighboring(local: Shared): Field<ID, Shared> =
    neighboring(local, dataSharingMethod<Shared>())

/** The field of the aligned neighbours, without values. */
public fun <ID : Any> Aggregate<ID>.neighborhood(): Field<ID, *> = neighboring(Unit).mapToConstant(Unit)

/** Returns a field with the result of [local] for the id of each aligned neighbour and of this device. */
public inline fun <ID : Any, Value> Aggregate<ID>.mapNeighborhood(crossinline local: (ID) -> Value): Field<ID, Value> =
    neighborhood().map { local(it.id) }
