package it.unibo.collektive.stdlib.floats

import it.unibo.collektive.aggregate.Field

/**
 * The operators and conversions of [Float] for fields, entry by entry: `distances + 1`, `distances * weights`, `distances.toLong()`.
 *
 * Two fields must have the same devices; otherwise an operator throws an [IllegalStateException]. Overflow, rounding and errors are
 * those of [Float]'s members.
 */
public object FieldedFloats {
    /** Each value [+][Float.plus] [other]'s. */
    @JvmName("plusFieldInt")
    public operator fun <ID : Any> Field<ID, Float>.plus(other: Field<ID, Int>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Float.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.plus(other: Int): Field<ID, Float> = mapValues { it + other }

    /** This value [+][Float.plus] each of [other]'s. */
    @JvmName("floatPlusFieldInt")
    public operator fun <ID : Any> Float.plus(other: Field<ID, Int>): Field<ID, Float> = other.mapValues { this + it }

    /** Each value [+][Float.plus] [other]'s. */
    @JvmName("plusFieldLong")
    public operator fun <ID : Any> Field<ID, Float>.plus(other: Field<ID, Long>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Float.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.plus(other: Long): Field<ID, Float> = mapValues { it + other }

    /** This value [+][Float.plus] each of [other]'s. */
    @JvmName("floatPlusFieldLong")
    public operator fun <ID : Any> Float.plus(other: Field<ID, Long>): Field<ID, Float> = other.mapValues { this + it }

    /** Each value [+][Float.plus] [other]'s. */
    @JvmName("plusFieldFloat")
    public operator fun <ID : Any> Field<ID, Float>.plus(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Float.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.plus(other: Float): Field<ID, Float> = mapValues { it + other }

    /** This value [+][Float.plus] each of [other]'s. */
    @JvmName("floatPlusFieldFloat")
    public operator fun <ID : Any> Float.plus(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this + it }

    /** Each value [+][Float.plus] [other]'s. */
    @JvmName("plusFieldDouble")
    public operator fun <ID : Any> Field<ID, Float>.plus(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Float.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.plus(other: Double): Field<ID, Double> = mapValues { it + other }

    /** This value [+][Float.plus] each of [other]'s. */
    @JvmName("floatPlusFieldDouble")
    public operator fun <ID : Any> Float.plus(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this + it }

    /** Each value [-][Float.minus] [other]'s. */
    @JvmName("minusFieldInt")
    public operator fun <ID : Any> Field<ID, Float>.minus(other: Field<ID, Int>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Float.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.minus(other: Int): Field<ID, Float> = mapValues { it - other }

    /** This value [-][Float.minus] each of [other]'s. */
    @JvmName("floatMinusFieldInt")
    public operator fun <ID : Any> Float.minus(other: Field<ID, Int>): Field<ID, Float> = other.mapValues { this - it }

    /** Each value [-][Float.minus] [other]'s. */
    @JvmName("minusFieldLong")
    public operator fun <ID : Any> Field<ID, Float>.minus(other: Field<ID, Long>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Float.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.minus(other: Long): Field<ID, Float> = mapValues { it - other }

    /** This value [-][Float.minus] each of [other]'s. */
    @JvmName("floatMinusFieldLong")
    public operator fun <ID : Any> Float.minus(other: Field<ID, Long>): Field<ID, Float> = other.mapValues { this - it }

    /** Each value [-][Float.minus] [other]'s. */
    @JvmName("minusFieldFloat")
    public operator fun <ID : Any> Field<ID, Float>.minus(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Float.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.minus(other: Float): Field<ID, Float> = mapValues { it - other }

    /** This value [-][Float.minus] each of [other]'s. */
    @JvmName("floatMinusFieldFloat")
    public operator fun <ID : Any> Float.minus(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this - it }

    /** Each value [-][Float.minus] [other]'s. */
    @JvmName("minusFieldDouble")
    public operator fun <ID : Any> Field<ID, Float>.minus(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Float.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.minus(other: Double): Field<ID, Double> = mapValues { it - other }

    /** This value [-][Float.minus] each of [other]'s. */
    @JvmName("floatMinusFieldDouble")
    public operator fun <ID : Any> Float.minus(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this - it }

    /** Each value [*][Float.times] [other]'s. */
    @JvmName("timesFieldInt")
    public operator fun <ID : Any> Field<ID, Float>.times(other: Field<ID, Int>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Float.times] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.times(other: Int): Field<ID, Float> = mapValues { it * other }

    /** This value [*][Float.times] each of [other]'s. */
    @JvmName("floatTimesFieldInt")
    public operator fun <ID : Any> Float.times(other: Field<ID, Int>): Field<ID, Float> = other.mapValues { this * it }

    /** Each value [*][Float.times] [other]'s. */
    @JvmName("timesFieldLong")
    public operator fun <ID : Any> Field<ID, Float>.times(other: Field<ID, Long>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Float.times] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.times(other: Long): Field<ID, Float> = mapValues { it * other }

    /** This value [*][Float.times] each of [other]'s. */
    @JvmName("floatTimesFieldLong")
    public operator fun <ID : Any> Float.times(other: Field<ID, Long>): Field<ID, Float> = other.mapValues { this * it }

    /** Each value [*][Float.times] [other]'s. */
    @JvmName("timesFieldFloat")
    public operator fun <ID : Any> Field<ID, Float>.times(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Float.times] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.times(other: Float): Field<ID, Float> = mapValues { it * other }

    /** This value [*][Float.times] each of [other]'s. */
    @JvmName("floatTimesFieldFloat")
    public operator fun <ID : Any> Float.times(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this * it }

    /** Each value [*][Float.times] [other]'s. */
    @JvmName("timesFieldDouble")
    public operator fun <ID : Any> Field<ID, Float>.times(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Float.times] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.times(other: Double): Field<ID, Double> = mapValues { it * other }

    /** This value [*][Float.times] each of [other]'s. */
    @JvmName("floatTimesFieldDouble")
    public operator fun <ID : Any> Float.times(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this * it }

    /** Each value [/][Float.div] [other]'s. */
    @JvmName("divFieldInt")
    public operator fun <ID : Any> Field<ID, Float>.div(other: Field<ID, Int>): Field<ID, Float> = alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Float.div] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.div(other: Int): Field<ID, Float> = mapValues { it / other }

    /** This value [/][Float.div] each of [other]'s. */
    @JvmName("floatDivFieldInt")
    public operator fun <ID : Any> Float.div(other: Field<ID, Int>): Field<ID, Float> = other.mapValues { this / it }

    /** Each value [/][Float.div] [other]'s. */
    @JvmName("divFieldLong")
    public operator fun <ID : Any> Field<ID, Float>.div(other: Field<ID, Long>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Float.div] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.div(other: Long): Field<ID, Float> = mapValues { it / other }

    /** This value [/][Float.div] each of [other]'s. */
    @JvmName("floatDivFieldLong")
    public operator fun <ID : Any> Float.div(other: Field<ID, Long>): Field<ID, Float> = other.mapValues { this / it }

    /** Each value [/][Float.div] [other]'s. */
    @JvmName("divFieldFloat")
    public operator fun <ID : Any> Field<ID, Float>.div(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Float.div] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.div(other: Float): Field<ID, Float> = mapValues { it / other }

    /** This value [/][Float.div] each of [other]'s. */
    @JvmName("floatDivFieldFloat")
    public operator fun <ID : Any> Float.div(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this / it }

    /** Each value [/][Float.div] [other]'s. */
    @JvmName("divFieldDouble")
    public operator fun <ID : Any> Field<ID, Float>.div(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Float.div] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.div(other: Double): Field<ID, Double> = mapValues { it / other }

    /** This value [/][Float.div] each of [other]'s. */
    @JvmName("floatDivFieldDouble")
    public operator fun <ID : Any> Float.div(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this / it }

    /** Each value [%][Float.rem] [other]'s. */
    @JvmName("remFieldInt")
    public operator fun <ID : Any> Field<ID, Float>.rem(other: Field<ID, Int>): Field<ID, Float> = alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Float.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.rem(other: Int): Field<ID, Float> = mapValues { it % other }

    /** This value [%][Float.rem] each of [other]'s. */
    @JvmName("floatRemFieldInt")
    public operator fun <ID : Any> Float.rem(other: Field<ID, Int>): Field<ID, Float> = other.mapValues { this % it }

    /** Each value [%][Float.rem] [other]'s. */
    @JvmName("remFieldLong")
    public operator fun <ID : Any> Field<ID, Float>.rem(other: Field<ID, Long>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Float.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.rem(other: Long): Field<ID, Float> = mapValues { it % other }

    /** This value [%][Float.rem] each of [other]'s. */
    @JvmName("floatRemFieldLong")
    public operator fun <ID : Any> Float.rem(other: Field<ID, Long>): Field<ID, Float> = other.mapValues { this % it }

    /** Each value [%][Float.rem] [other]'s. */
    @JvmName("remFieldFloat")
    public operator fun <ID : Any> Field<ID, Float>.rem(other: Field<ID, Float>): Field<ID, Float> =
        alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Float.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.rem(other: Float): Field<ID, Float> = mapValues { it % other }

    /** This value [%][Float.rem] each of [other]'s. */
    @JvmName("floatRemFieldFloat")
    public operator fun <ID : Any> Float.rem(other: Field<ID, Float>): Field<ID, Float> = other.mapValues { this % it }

    /** Each value [%][Float.rem] [other]'s. */
    @JvmName("remFieldDouble")
    public operator fun <ID : Any> Field<ID, Float>.rem(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Float.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Float>.rem(other: Double): Field<ID, Double> = mapValues { it % other }

    /** This value [%][Float.rem] each of [other]'s. */
    @JvmName("floatRemFieldDouble")
    public operator fun <ID : Any> Float.rem(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this % it }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldInt")
    public fun <ID : Any> Field<ID, Float>.compareTo(other: Field<ID, Int>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Float>.compareTo(other: Int): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldLong")
    public fun <ID : Any> Field<ID, Float>.compareTo(other: Field<ID, Long>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Float>.compareTo(other: Long): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldFloat")
    public fun <ID : Any> Field<ID, Float>.compareTo(other: Field<ID, Float>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Float>.compareTo(other: Float): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldDouble")
    public fun <ID : Any> Field<ID, Float>.compareTo(other: Field<ID, Double>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Float>.compareTo(other: Double): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** Each value, negated. */
    public operator fun <ID : Any> Field<ID, Float>.unaryMinus(): Field<ID, Float> = mapValues { -it }

    /** Each value as it is. */
    public operator fun <ID : Any> Field<ID, Float>.unaryPlus(): Field<ID, Float> = this

    /** Each value plus 1. */
    public operator fun <ID : Any> Field<ID, Float>.inc(): Field<ID, Float> = mapValues { it.inc() }

    /** Each value minus 1. */
    public operator fun <ID : Any> Field<ID, Float>.dec(): Field<ID, Float> = mapValues { it.dec() }

    /** Each value, converted by [Float.toInt]. */
    public fun <ID : Any> Field<ID, Float>.toInt(): Field<ID, Int> = mapValues { it.toInt() }

    /** Each value, converted by [Float.toLong]. */
    public fun <ID : Any> Field<ID, Float>.toLong(): Field<ID, Long> = mapValues { it.toLong() }

    /** Each value, converted by [Float.toDouble]. */
    public fun <ID : Any> Field<ID, Float>.toDouble(): Field<ID, Double> = mapValues { it.toDouble() }
}
