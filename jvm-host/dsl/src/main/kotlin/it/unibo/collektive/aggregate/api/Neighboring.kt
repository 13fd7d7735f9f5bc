@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.aggregate.api

import it.unibo.collektive.aggregate.Field

/** Sends [local] to all neighbours and returns what aligned neighbours sent here, with [local] as the local value. */
public inline fun <ID : Any, reified Shared> Aggregate<ID>.neighboring(local: Shared): Field<ID, Shared> =
    neighboring(local, dataSharingMethod<Shared>())

/** The aligned neighbours, without values. */
public fun <ID : Any> Aggregate<ID>.neighborhood(): Field<ID, Unit> = neighboring(Unit)

/** A field of [transform] applied to the id of each aligned neighbour and to the own one. */
public fun <ID : Any, Value> Aggregate<ID>.mapNeighborhood(transform: (ID) -> Value): Field<ID, Value> =
    neighborhood().map { transform(it.id) }
