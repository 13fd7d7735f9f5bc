package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.FieldEntry

/** Returns the ids of the entries. */
public fun <ID : Any> Sequence<FieldEntry<ID, *>>.ids(): Sequence<ID> = map { it.id }

/** Returns the values of the entries. */
public fun <T> Sequence<FieldEntry<*, T>>.values(): Sequence<T> = map { it.value }
