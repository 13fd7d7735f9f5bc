@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.neighborhood

/** Returns the distances in hops, which are 1 for each neighbour and 0 for this device. */
public fun <ID : Any> Aggregate<ID>.hops(): Field<ID, Int> = aligned("hops") { neighborhood().map { if (it.id == localId) 0 else 1 } }
