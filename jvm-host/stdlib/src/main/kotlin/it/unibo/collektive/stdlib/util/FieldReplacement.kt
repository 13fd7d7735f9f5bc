package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry

/**
 * Each value, limited to [min]..[max].
 *
 * @throws IllegalArgumentException when [min] is greater than [max].
 */
public fun <ID : Any, T : Comparable<T>> Field<ID, T>.coerceIn(min: T, max: T): Field<ID, T> = mapValues { it.coerceIn(min, max) }

/** Each value, or [replacement] where [predicate] holds for its entry. */
public fun <ID : Any, T> Field<ID, T>.replaceMatching(replacement: T, predicate: (FieldEntry<ID, T>) -> Boolean): Field<ID, T> =
    map { if (predicate(it)) replacement else it.value }

/** Each value, or [replacement] where [predicate] holds for it. */
public fun <ID : Any, T> Field<ID, T>.replaceMatchingValues(replacement: T, predicate: (T) -> Boolean): Field<ID, T> =
    mapValues { if (predicate(it)) replacement else it }
