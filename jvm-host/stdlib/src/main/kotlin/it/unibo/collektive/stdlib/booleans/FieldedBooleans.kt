package it.unibo.collektive.stdlib.booleans

import it.unibo.collektive.aggregate.Field

/**
 * The operators of [Boolean] for fields, entry by entry. Both sides are always evaluated.
 *
 * Two fields must have the same devices; otherwise an operator throws an [IllegalStateException].
 */
public object FieldedBooleans {
    /** Each value [and][Boolean.and] [other]'s. */
    public infix fun <ID : Any> Field<ID, Boolean>.and(other: Field<ID, Boolean>): Field<ID, Boolean> =
        alignedMapValues(other) { a, b -> a and b }

    /** Each value [and][Boolean.and] [other]. */
    public infix fun <ID : Any> Field<ID, Boolean>.and(other: Boolean): Field<ID, Boolean> = mapValues { it and other }

    /** Each value [or][Boolean.or] [other]'s. */
    public infix fun <ID : Any> Field<ID, Boolean>.or(other: Field<ID, Boolean>): Field<ID, Boolean> =
        alignedMapValues(other) { a, b -> a or b }

    /** Each value [or][Boolean.or] [other]. */
    public infix fun <ID : Any> Field<ID, Boolean>.or(other: Boolean): Field<ID, Boolean> = mapValues { it or other }

    /** Each value [xor][Boolean.xor] [other]'s. */
    public infix fun <ID : Any> Field<ID, Boolean>.xor(other: Field<ID, Boolean>): Field<ID, Boolean> =
        alignedMapValues(other) { a, b -> a xor b }

    /** Each value [xor][Boolean.xor] [other]. */
    public infix fun <ID : Any> Field<ID, Boolean>.xor(other: Boolean): Field<ID, Boolean> = mapValues { it xor other }

    /** Each value, inverted. */
    public operator fun <ID : Any> Field<ID, Boolean>.not(): Field<ID, Boolean> = mapValues { !it }

    /** How each value compares with [other]'s: `false` is less than `true`. */
    public fun <ID : Any> Field<ID, Boolean>.compareTo(other: Field<ID, Boolean>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: `false` is less than `true`. */
    public fun <ID : Any> Field<ID, Boolean>.compareTo(other: Boolean): Field<ID, Int> = mapValues { it.compareTo(other) }
}
