package it.unibo.collektive.stdlib.longs

import it.unibo.collektive.aggregate.Field

/**
 * The operators and conversions of [Long] for fields, entry by entry: `distances + 1`, `distances * weights`, `distances.toInt()`.
 *
 * Two fields must have the same devices; otherwise an operator throws an [IllegalStateException]. Overflow, rounding and errors are
 * those of [Long]'s members.
 */
public object FieldedLongs {
    /** Each value [+][Long.plus] [other]'s. */
    @JvmName("plusFieldInt")
    public operator fun <ID : Any> Field<ID, Long>.plus(other: Field<ID, Int>): Field<ID, Long> = alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Long.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.plus(other: Int): Field<ID, Long> = mapValues { it + other }

    /** This value [+][Long.plus] each of [other]'s. */
    @JvmName("longPlusFieldInt")
    public operator fun <ID : Any> Long.plus(other: Field<ID, Int>): Field<ID, Long> = other.mapValues { this + it }

    /** Each value [+][Long.plus] [other]'s. */
    @JvmName("plusFieldLong")
    public operator fun <ID : Any> Field<ID, Long>.plus(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Long.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.plus(other: Long): Field<ID, Long> = mapValues { it + other }

    /** This value [+][Long.plus] each of [other]'s. */
    @JvmName("longPlusFieldLong")
    public operator fun <ID : Any> Long.plus(other: Field<ID, Long>): Field<ID, Long> = other.mapValues { this + it }

    /** Each value [+][Long.plus] [other]'s. */
    @JvmName("plusFieldFloat")
    public operator fun <ID : Any> Field<ID, Long>.plus(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Long.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.plus(other: Float): Field<ID, Float> = mapValues { it + other }

    /** This value [+][Long.plus] each of [other]'s. */
    @JvmName("longPlusFieldFloat")
    public operator fun <ID : Any> Long.plus(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this + it }

    /** Each value [+][Long.plus] [other]'s. */
    @JvmName("plusFieldDouble")
    public operator fun <ID : Any> Field<ID, Long>.plus(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Long.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.plus(other: Double): Field<ID, Double> = mapValues { it + other }

    /** This value [+][Long.plus] each of [other]'s. */
    @JvmName("longPlusFieldDouble")
    public operator fun <ID : Any> Long.plus(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this + it }

    /** Each value [-][Long.minus] [other]'s. */
    @JvmName("minusFieldInt")
    public operator fun <ID : Any> Field<ID, Long>.minus(other: Field<ID, Int>): Field<ID, Long> = alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Long.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.minus(other: Int): Field<ID, Long> = mapValues { it - other }

    /** This value [-][Long.minus] each of [other]'s. */
    @JvmName("longMinusFieldInt")
    public operator fun <ID : Any> Long.minus(other: Field<ID, Int>): Field<ID, Long> = other.mapValues { this - it }

    /** Each value [-][Long.minus] [other]'s. */
    @JvmName("minusFieldLong")
    public operator fun <ID : Any> Field<ID, Long>.minus(other: Field<ID, Long>): Field<ID, Long> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Long.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.minus(other: Long): Field<ID, Long> = mapValues { it - other }

    /** This value [-][Long.minus] each of [other]'s. */
    @JvmName("longMinusFieldLong")
    public operator fun <ID : Any> Long.minus(other: Field<ID, Long>): Field<ID, Long> = other.mapValues { this - it }

    /** Each value [-][Long.minus] [other]'s. */
    @JvmName("minusFieldFloat")
    public operator fun <ID : Any> Field<ID, Long>.minus(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Long.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.minus(other: Float): Field<ID, Float> = mapValues { it - other }

    /** This value [-][Long.minus] each of [other]'s. */
    @JvmName("longMinusFieldFloat")
    public operator fun <ID : Any> Long.minus(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this - it }

    /** Each value [-][Long.minus] [other]'s. */
    @JvmName("minusFieldDouble")
    public operator fun <ID : Any> Field<ID, Long>.minus(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Long.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.minus(other: Double): Field<ID, Double> = mapValues { it - other }

    /** This value [-][Long.minus] each of [other]'s. */
    @JvmName("longMinusFieldDouble")
    public operator fun <ID : Any> Long.minus(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this - it }

    /** Each value [*][Long.times] [other]'s. */
    @JvmName("timesFieldInt")
    public operator fun <ID : Any> Field<ID, Long>.times(other: Field<ID, Int>): Field<ID, Long> = alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Long.times] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.times(other: Int): Field<ID, Long> = mapValues { it * other }

    /** This value [*][Long.times] each of [other]'s. */
    @JvmName("longTimesFieldInt")
    public operator fun <ID : Any> Long.times(other: Field<ID, Int>): Field<ID, Long> = other.mapValues { this * it }

    /** Each value [*][Long.times] [other]'s. */
    @JvmName("timesFieldLong")
    public operator fun <ID : Any> Field<ID, Long>.times(other: Field<ID, Long>): Field<ID, Long> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Long.times] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.times(other: Long): Field<ID, Long> = mapValues { it * other }

    /** This value [*][Long.times] each of [other]'s. */
    @JvmName("longTimesFieldLong")
    public operator fun <ID : Any> Long.times(other: Field<ID, Long>): Field<ID, Long> = other.mapValues { this * it }

    /** Each value [*][Long.times] [other]'s. */
    @JvmName("timesFieldFloat")
    public operator fun <ID : Any> Field<ID, Long>.times(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Long.times] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.times(other: Float): Field<ID, Float> = mapValues { it * other }

    /** This value [*][Long.times] each of [other]'s. */
    @JvmName("longTimesFieldFloat")
    public operator fun <ID : Any> Long.times(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this * it }

    /** Each value [*][Long.times] [other]'s. */
    @JvmName("timesFieldDouble")
    public operator fun <ID : Any> Field<ID, Long>.times(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Long.times] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.times(other: Double): Field<ID, Double> = mapValues { it * other }

    /** This value [*][Long.times] each of [other]'s. */
    @JvmName("longTimesFieldDouble")
    public operator fun <ID : Any> Long.times(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this * it }

    /** Each value [/][Long.div] [other]'s. */
    @JvmName("divFieldInt")
    public operator fun <ID : Any> Field<ID, Long>.div(other: Field<ID, Int>): Field<ID, Long> = alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Long.div] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.div(other: Int): Field<ID, Long> = mapValues { it / other }

    /** This value [/][Long.div] each of [other]'s. */
    @JvmName("longDivFieldInt")
    public operator fun <ID : Any> Long.div(other: Field<ID, Int>): Field<ID, Long> = other.mapValues { this / it }

    /** Each value [/][Long.div] [other]'s. */
    @JvmName("divFieldLong")
    public operator fun <ID : Any> Field<ID, Long>.div(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Long.div] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.div(other: Long): Field<ID, Long> = mapValues { it / other }

    /** This value [/][Long.div] each of [other]'s. */
    @JvmName("longDivFieldLong")
    public operator fun <ID : Any> Long.div(other: Field<ID, Long>): Field<ID, Long> = other.mapValues { this / it }

    /** Each value [/][Long.div] [other]'s. */
    @JvmName("divFieldFloat")
    public operator fun <ID : Any> Field<ID, Long>.div(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Long.div] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.div(other: Float): Field<ID, Float> = mapValues { it / other }

    /** This value [/][Long.div] each of [other]'s. */
    @JvmName("longDivFieldFloat")
    public operator fun <ID : Any> Long.div(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this / it }

    /** Each value [/][Long.div] [other]'s. */
    @JvmName("divFieldDouble")
    public operator fun <ID : Any> Field<ID, Long>.div(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Long.div] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.div(other: Double): Field<ID, Double> = mapValues { it / other }

    /** This value [/][Long.div] each of [other]'s. */
    @JvmName("longDivFieldDouble")
    public operator fun <ID : Any> Long.div(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this / it }

    /** Each value [%][Long.rem] [other]'s. */
    @JvmName("remFieldInt")
    public operator fun <ID : Any> Field<ID, Long>.rem(other: Field<ID, Int>): Field<ID, Long> = alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Long.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.rem(other: Int): Field<ID, Long> = mapValues { it % other }

    /** This value [%][Long.rem] each of [other]'s. */
    @JvmName("longRemFieldInt")
    public operator fun <ID : Any> Long.rem(other: Field<ID, Int>): Field<ID, Long> = other.mapValues { this % it }

    /** Each value [%][Long.rem] [other]'s. */
    @JvmName("remFieldLong")
    public operator fun <ID : Any> Field<ID, Long>.rem(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Long.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.rem(other: Long): Field<ID, Long> = mapValues { it % other }

    /** This value [%][Long.rem] each of [other]'s. */
    @JvmName("longRemFieldLong")
    public operator fun <ID : Any> Long.rem(other: Field<ID, Long>): Field<ID, Long> = other.mapValues { this % it }

    /** Each value [%][Long.rem] [other]'s. */
    @JvmName("remFieldFloat")
    public operator fun <ID : Any> Field<ID, Long>.rem(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Long.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.rem(other: Float): Field<ID, Float> = mapValues { it % other }

    /** This value [%][Long.rem] each of [other]'s. */
    @JvmName("longRemFieldFloat")
    public operator fun <ID : Any> Long.rem(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this % it }

    /** Each value [%][Long.rem] [other]'s. */
    @JvmName("remFieldDouble")
    public operator fun <ID : Any> Field<ID, Long>.rem(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Long.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Long>.rem(other: Double): Field<ID, Double> = mapValues { it % other }

    /** This value [%][Long.rem] each of [other]'s. */
    @JvmName("longRemFieldDouble")
    public operator fun <ID : Any> Long.rem(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this % it }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldInt")
    public fun <ID : Any> Field<ID, Long>.compareTo(other: Field<ID, Int>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Long>.compareTo(other: Int): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldLong")
    public fun <ID : Any> Field<ID, Long>.compareTo(other: Field<ID, Long>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Long>.compareTo(other: Long): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldFloat")
    public fun <ID : Any> Field<ID, Long>.compareTo(other: Field<ID, Float>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Long>.compareTo(other: Float): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldDouble")
    public fun <ID : Any> Field<ID, Long>.compareTo(other: Field<ID, Double>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Long>.compareTo(other: Double): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** Each value, negated. */
    public operator fun <ID : Any> Field<ID, Long>.unaryMinus(): Field<ID, Long> = mapValues { -it }

    /** Each value as it is. */
    public operator fun <ID : Any> Field<ID, Long>.unaryPlus(): Field<ID, Long> = this

    /** Each value plus 1. */
    public operator fun <ID : Any> Field<ID, Long>.inc(): Field<ID, Long> = mapValues { it.inc() }

    /** Each value minus 1. */
    public operator fun <ID : Any> Field<ID, Long>.dec(): Field<ID, Long> = mapValues { it.dec() }

    /** Each value, converted by [Long.toInt]. */
    public fun <ID : Any> Field<ID, Long>.toInt(): Field<ID, Int> = mapValues { it.toInt() }

    /** Each value, converted by [Long.toFloat]. */
    public fun <ID : Any> Field<ID, Long>.toFloat(): Field<ID, Float> = mapValues { it.toFloat() }

    /** Each value, converted by [Long.toDouble]. */
    public fun <ID : Any> Field<ID, Long>.toDouble(): Field<ID, Double> = mapValues { it.toDouble() }

    /** Each value [and][Long.and] [other]'s, bit by bit. */
    public infix fun <ID : Any> Field<ID, Long>.and(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a and b }

    /** Each value [and][Long.and] [other], bit by bit. */
    public infix fun <ID : Any> Field<ID, Long>.and(other: Long): Field<ID, Long> = mapValues { it and other }

    /** Each value [or][Long.or] [other]'s, bit by bit. */
    public infix fun <ID : Any> Field<ID, Long>.or(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a or b }

    /** Each value [or][Long.or] [other], bit by bit. */
    public infix fun <ID : Any> Field<ID, Long>.or(other: Long): Field<ID, Long> = mapValues { it or other }

    /** Each value [xor][Long.xor] [other]'s, bit by bit. */
    public infix fun <ID : Any> Field<ID, Long>.xor(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a xor b }

    /** Each value [xor][Long.xor] [other], bit by bit. */
    public infix fun <ID : Any> Field<ID, Long>.xor(other: Long): Field<ID, Long> = mapValues { it xor other }

    /** Each value with all its bits inverted. */
    public fun <ID : Any> Field<ID, Long>.inv(): Field<ID, Long> = mapValues { it.inv() }

    /** Each value, shifted by [bitCount] ([Long.shl]). */
    public infix fun <ID : Any> Field<ID, Long>.shl(bitCount: Int): Field<ID, Long> = mapValues { it shl bitCount }

    /** Each value, shifted by [bitCount] ([Long.shr]). */
    public infix fun <ID : Any> Field<ID, Long>.shr(bitCount: Int): Field<ID, Long> = mapValues { it shr bitCount }

    /** Each value, shifted by [bitCount] ([Long.ushr]). */
    public infix fun <ID : Any> Field<ID, Long>.ushr(bitCount: Int): Field<ID, Long> = mapValues { it ushr bitCount }
}
