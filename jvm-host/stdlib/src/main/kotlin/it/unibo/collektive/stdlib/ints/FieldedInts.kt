package it.unibo.collektive.stdlib.ints

import it.unibo.collektive.aggregate.Field

/**
 * The operators and conversions of [Int] for fields, entry by entry: `distances + 1`, `distances * weights`, `distances.toLong()`.
 *
 * Two fields must have the same devices; otherwise an operator throws an [IllegalStateException]. Overflow, rounding and errors are
 * those of [Int]'s members.
 */
public object FieldedInts {
    /** Each value [+][Int.plus] [other]'s. */
    @JvmName("plusFieldInt")
    public operator fun <ID : Any> Field<ID, Int>.plus(other: Field<ID, Int>): Field<ID, Int> = alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Int.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.plus(other: Int): Field<ID, Int> = mapValues { it + other }

    /** This value [+][Int.plus] each of [other]'s. */
    @JvmName("intPlusFieldInt")
    public operator fun <ID : Any> Int.plus(other: Field<ID, Int>): Field<ID, Int> = other.mapValues { this + it }

    /** Each value [+][Int.plus] [other]'s. */
    @JvmName("plusFieldLong")
    public operator fun <ID : Any> Field<ID, Int>.plus(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Int.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.plus(other: Long): Field<ID, Long> = mapValues { it + other }

    /** This value [+][Int.plus] each of [other]'s. */
    @JvmName("intPlusFieldLong")
    public operator fun <ID : Any> Int.plus(other: Field<ID, Long>): Field<ID, Long> = other.mapValues { this + it }

    /** Each value [+][Int.plus] [other]'s. */
    @JvmName("plusFieldFloat")
    public operator fun <ID : Any> Field<ID, Int>.plus(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Int.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.plus(other: Float): Field<ID, Float> = mapValues { it + other }

    /** This value [+][Int.plus] each of [other]'s. */
    @JvmName("intPlusFieldFloat")
    public operator fun <ID : Any> Int.plus(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this + it }

    /** Each value [+][Int.plus] [other]'s. */
    @JvmName("plusFieldDouble")
    public operator fun <ID : Any> Field<ID, Int>.plus(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Int.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.plus(other: Double): Field<ID, Double> = mapValues { it + other }

    /** This value [+][Int.plus] each of [other]'s. */
    @JvmName("intPlusFieldDouble")
    public operator fun <ID : Any> Int.plus(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this + it }

    /** Each value [-][Int.minus] [other]'s. */
    @JvmName("minusFieldInt")
    public operator fun <ID : Any> Field<ID, Int>.minus(other: Field<ID, Int>): Field<ID, Int> = alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Int.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.minus(other: Int): Field<ID, Int> = mapValues { it - other }

    /** This value [-][Int.minus] each of [other]'s. */
    @JvmName("intMinusFieldInt")
    public operator fun <ID : Any> Int.minus(other: Field<ID, Int>): Field<ID, Int> = other.mapValues { this - it }

    /** Each value [-][Int.minus] [other]'s. */
    @JvmName("minusFieldLong")
    public operator fun <ID : Any> Field<ID, Int>.minus(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Int.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.minus(other: Long): Field<ID, Long> = mapValues { it - other }

    /** This value [-][Int.minus] each of [other]'s. */
    @JvmName("intMinusFieldLong")
    public operator fun <ID : Any> Int.minus(other: Field<ID, Long>): Field<ID, Long> = other.mapValues { this - it }

    /** Each value [-][Int.minus] [other]'s. */
    @JvmName("minusFieldFloat")
    public operator fun <ID : Any> Field<ID, Int>.minus(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Int.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.minus(other: Float): Field<ID, Float> = mapValues { it - other }

    /** This value [-][Int.minus] each of [other]'s. */
    @JvmName("intMinusFieldFloat")
    public operator fun <ID : Any> Int.minus(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this - it }

    /** Each value [-][Int.minus] [other]'s. */
    @JvmName("minusFieldDouble")
    public operator fun <ID : Any> Field<ID, Int>.minus(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Int.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.minus(other: Double): Field<ID, Double> = mapValues { it - other }

    /** This value [-][Int.minus] each of [other]'s. */
    @JvmName("intMinusFieldDouble")
    public operator fun <ID : Any> Int.minus(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this - it }

    /** Each value [*][Int.times] [other]'s. */
    @JvmName("timesFieldInt")
    public operator fun <ID : Any> Field<ID, Int>.times(other: Field<ID, Int>): Field<ID, Int> = alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Int.times] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.times(other: Int): Field<ID, Int> = mapValues { it * other }

    /** This value [*][Int.times] each of [other]'s. */
    @JvmName("intTimesFieldInt")
    public operator fun <ID : Any> Int.times(other: Field<ID, Int>): Field<ID, Int> = other.mapValues { this * it }

    /** Each value [*][Int.times] [other]'s. */
    @JvmName("timesFieldLong")
    public operator fun <ID : Any> Field<ID, Int>.times(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Int.times] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.times(other: Long): Field<ID, Long> = mapValues { it * other }

    /** This value [*][Int.times] each of [other]'s. */
    @JvmName("intTimesFieldLong")
    public operator fun <ID : Any> Int.times(other: Field<ID, Long>): Field<ID, Long> = other.mapValues { this * it }

    /** Each value [*][Int.times] [other]'s. */
    @JvmName("timesFieldFloat")
    public operator fun <ID : Any> Field<ID, Int>.times(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Int.times] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.times(other: Float): Field<ID, Float> = mapValues { it * other }

    /** This value [*][Int.times] each of [other]'s. */
    @JvmName("intTimesFieldFloat")
    public operator fun <ID : Any> Int.times(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this * it }

    /** Each value [*][Int.times] [other]'s. */
    @JvmName("timesFieldDouble")
    public operator fun <ID : Any> Field<ID, Int>.times(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Int.times] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.times(other: Double): Field<ID, Double> = mapValues { it * other }

    /** This value [*][Int.times] each of [other]'s. */
    @JvmName("intTimesFieldDouble")
    public operator fun <ID : Any> Int.times(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this * it }

    /** Each value [/][Int.div] [other]'s. */
    @JvmName("divFieldInt")
    public operator fun <ID : Any> Field<ID, Int>.div(other: Field<ID, Int>): Field<ID, Int> = alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Int.div] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.div(other: Int): Field<ID, Int> = mapValues { it / other }

    /** This value [/][Int.div] each of [other]'s. */
    @JvmName("intDivFieldInt")
    public operator fun <ID : Any> Int.div(other: Field<ID, Int>): Field<ID, Int> = other.mapValues { this / it }

    /** Each value [/][Int.div] [other]'s. */
    @JvmName("divFieldLong")
    public operator fun <ID : Any> Field<ID, Int>.div(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Int.div] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.div(other: Long): Field<ID, Long> = mapValues { it / other }

    /** This value [/][Int.div] each of [other]'s. */
    @JvmName("intDivFieldLong")
    public operator fun <ID : Any> Int.div(other: Field<ID, Long>): Field<ID, Long> = other.mapValues { this / it }

    /** Each value [/][Int.div] [other]'s. */
    @JvmName("divFieldFloat")
    public operator fun <ID : Any> Field<ID, Int>.div(other: Field<ID, Float>): Field<ID, Float> = alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Int.div] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.div(other: Float): Field<ID, Float> = mapValues { it / other }

    /** This value [/][Int.div] each of [other]'s. */
    @JvmName("intDivFieldFloat")
    public operator fun <ID : Any> Int.div(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this / it }

    /** Each value [/][Int.div] [other]'s. */
    @JvmName("divFieldDouble")
    public operator fun <ID : Any> Field<ID, Int>.div(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Int.div] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.div(other: Double): Field<ID, Double> = mapValues { it / other }

    /** This value [/][Int.div] each of [other]'s. */
    @JvmName("intDivFieldDouble")
    public operator fun <ID : Any> Int.div(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this / it }

    /** Each value [%][Int.rem] [other]'s. */
    @JvmName("remFieldInt")
    public operator fun <ID : Any> Field<ID, Int>.rem(other: Field<ID, Int>): Field<ID, Int> = alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Int.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.rem(other: Int): Field<ID, Int> = mapValues { it % other }

    /** This value [%][Int.rem] each of [other]'s. */
    @JvmName("intRemFieldInt")
    public operator fun <ID : Any> Int.rem(other: Field<ID, Int>): Field<ID, Int> = other.mapValues { this % it }

    /** Each value [%][Int.rem] [other]'s. */
    @JvmName("remFieldLong")
    public operator fun <ID : Any> Field<ID, Int>.rem(other: Field<ID, Long>): Field<ID, Long> = alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Int.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.rem(other: Long): Field<ID, Long> = mapValues { it % other }

    /** This value [%][Int.rem] each of [other]'s. */
    @JvmName("intRemFieldLong")
    public operator fun <ID : Any> Int.rem(other: Field<ID, Long>): Field<ID, Long> = other.mapValues { this % it }

    /** Each value [%][Int.rem] [other]'s. */
    @JvmName("remFieldFloat")
    public operator fun <ID : Any> Field<ID, Int>.rem(other: Field<ID, Float>): Field<ID, Float> = alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Int.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.rem(other: Float): Field<ID, Float> = mapValues { it % other }

    /** This value [%][Int.rem] each of [other]'s. */
    @JvmName("intRemFieldFloat")
    public operator fun <ID : Any> Int.rem(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this % it }

    /** Each value [%][Int.rem] [other]'s. */
    @JvmName("remFieldDouble")
    public operator fun <ID : Any> Field<ID, Int>.rem(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Int.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Int>.rem(other: Double): Field<ID, Double> = mapValues { it % other }

    /** This value [%][Int.rem] each of [other]'s. */
    @JvmName("intRemFieldDouble")
    public operator fun <ID : Any> Int.rem(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this % it }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldInt")
    public fun <ID : Any> Field<ID, Int>.compareTo(other: Field<ID, Int>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Int>.compareTo(other: Int): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldLong")
    public fun <ID : Any> Field<ID, Int>.compareTo(other: Field<ID, Long>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Int>.compareTo(other: Long): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldFloat")
    public fun <ID : Any> Field<ID, Int>.compareTo(other: Field<ID, Float>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Int>.compareTo(other: Float): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldDouble")
    public fun <ID : Any> Field<ID, Int>.compareTo(other: Field<ID, Double>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Int>.compareTo(other: Double): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** Each value, negated. */
    public operator fun <ID : Any> Field<ID, Int>.unaryMinus(): Field<ID, Int> = mapValues { -it }

    /** Each value as it is. */
    public operator fun <ID : Any> Field<ID, Int>.unaryPlus(): Field<ID, Int> = this

    /** Each value plus 1. */
    public operator fun <ID : Any> Field<ID, Int>.inc(): Field<ID, Int> = mapValues { it.inc() }

    /** Each value minus 1. */
    public operator fun <ID : Any> Field<ID, Int>.dec(): Field<ID, Int> = mapValues { it.dec() }

    /** Each value, converted by [Int.toByte]. */
    public fun <ID : Any> Field<ID, Int>.toByte(): Field<ID, Byte> = mapValues { it.toByte() }

    /** Each value, converted by [Int.toShort]. */
    public fun <ID : Any> Field<ID, Int>.toShort(): Field<ID, Short> = mapValues { it.toShort() }

    /** Each value, converted by [Int.toLong]. */
    public fun <ID : Any> Field<ID, Int>.toLong(): Field<ID, Long> = mapValues { it.toLong() }

    /** Each value, converted by [Int.toFloat]. */
    public fun <ID : Any> Field<ID, Int>.toFloat(): Field<ID, Float> = mapValues { it.toFloat() }

    /** Each value, converted by [Int.toDouble]. */
    public fun <ID : Any> Field<ID, Int>.toDouble(): Field<ID, Double> = mapValues { it.toDouble() }

    /** Each value [and][Int.and] [other]'s, bit by bit. */
    public infix fun <ID : Any> Field<ID, Int>.and(other: Field<ID, Int>): Field<ID, Int> = alignedMapValues(other) { a, b -> a and b }

    /** Each value [and][Int.and] [other], bit by bit. */
    public infix fun <ID : Any> Field<ID, Int>.and(other: Int): Field<ID, Int> = mapValues { it and other }

    /** Each value [or][Int.or] [other]'s, bit by bit. */
    public infix fun <ID : Any> Field<ID, Int>.or(other: Field<ID, Int>): Field<ID, Int> = alignedMapValues(other) { a, b -> a or b }

    /** Each value [or][Int.or] [other], bit by bit. */
    public infix fun <ID : Any> Field<ID, Int>.or(other: Int): Field<ID, Int> = mapValues { it or other }

    /** Each value [xor][Int.xor] [other]'s, bit by bit. */
    public infix fun <ID : Any> Field<ID, Int>.xor(other: Field<ID, Int>): Field<ID, Int> = alignedMapValues(other) { a, b -> a xor b }

    /** Each value [xor][Int.xor] [other], bit by bit. */
    public infix fun <ID : Any> Field<ID, Int>.xor(other: Int): Field<ID, Int> = mapValues { it xor other }

    /** Each value with all its bits inverted. */
    public fun <ID : Any> Field<ID, Int>.inv(): Field<ID, Int> = mapValues { it.inv() }

    /** Each value, shifted by [bitCount] ([Int.shl]). */
    public infix fun <ID : Any> Field<ID, Int>.shl(bitCount: Int): Field<ID, Int> = mapValues { it shl bitCount }

    /** Each value, shifted by [bitCount] ([Int.shr]). */
    public infix fun <ID : Any> Field<ID, Int>.shr(bitCount: Int): Field<ID, Int> = mapValues { it shr bitCount }

    /** Each value, shifted by [bitCount] ([Int.ushr]). */
    public infix fun <ID : Any> Field<ID, Int>.ushr(bitCount: Int): Field<ID, Int> = mapValues { it ushr bitCount }
}
