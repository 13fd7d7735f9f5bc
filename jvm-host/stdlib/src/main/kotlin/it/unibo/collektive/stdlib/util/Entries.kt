package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.FieldEntry

/** The entries' ids. */
public fun <ID : Any> Sequence<FieldEntry<ID, *>>.ids(): Sequence<ID> = map { it.id }

/** The entries' values. */
public fun <T> Sequence<FieldEntry<*, T>>.values(): Sequence<T> = map { it.value }
