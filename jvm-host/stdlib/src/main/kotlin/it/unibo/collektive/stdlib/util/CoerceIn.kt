package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.Field

/**
 * Returns this value, limited to [min]..[max].
 *
 * @throws IllegalArgumentException when [min] is greater than [max]. The other overloads throw it too.
 */
public fun <T : Comparable<T>> T.coerceIn(min: T, max: T): T {
    require(min <= max) { "the range is empty: $min is greater than $max" }
    return if (this < min) {
        min
    } else if (this > max) {
        max
    } else {
        this
    }
}

/** Returns this value, limited to [range]. */
public fun <T : Comparable<T>> T.coerceIn(range: ClosedRange<T>): T = coerceIn(range.start, range.endInclusive)

/** Limits each value to [min]..[max]. */
public fun <ID : Any, T : Comparable<T>> Field<ID, T>.coerceIn(min: T, max: T): Field<ID, T> = mapValues { it.coerceIn(min, max) }

/** Limits each value to [range]. */
public fun <ID : Any, T : Comparable<T>> Field<ID, T>.coerceIn(range: ClosedRange<T>): Field<ID, T> = mapValues { it.coerceIn(range) }
