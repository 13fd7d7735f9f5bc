package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry

/** Replaces the values for whose entries [predicate] holds with [replacement]. */
public inline fun <ID : Any, T> Field<ID, T>.replaceMatching(
    replacement: T,
    crossinline predicate: (FieldEntry<ID, T>) -> Boolean,
): Field<ID, T> = map { if (predicate(it)) replacement else it.value }

/** Replaces the values for which [predicate] holds with [replacement]. */
public inline fun <ID : Any, T> Field<ID, T>.replaceMatchingValues(replacement: T, crossinline predicate: (T) -> Boolean): Field<ID, T> =
    mapValues { if (predicate(it)) replacement else it }
