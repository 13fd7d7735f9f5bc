package it.unibo.collektive.stdlib.doubles

import it.unibo.collektive.aggregate.Field

/**
 * The operators and conversions of [Double] for fields, entry by entry: `distances + 1`, `distances * weights`, `distances.toLong()`.
 *
 * Two fields must have the same devices; otherwise an operator throws an [IllegalStateException]. Overflow, rounding and errors are
 * those of [Double]'s members.
 */
public object FieldedDoubles {
    /** Each value [+][Double.plus] [other]'s. */
    @JvmName("plusFieldInt")
    public operator fun <ID : Any> Field<ID, Double>.plus(other: Field<ID, Int>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Double.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.plus(other: Int): Field<ID, Double> = mapValues { it + other }

    /** This value [+][Double.plus] each of [other]'s. */
    @JvmName("doublePlusFieldInt")
    public operator fun <ID : Any> Double.plus(other: Field<ID, Int>): Field<ID, Double> = other.mapValues { this + it }

    /** Each value [+][Double.plus] [other]'s. */
    @JvmName("plusFieldLong")
    public operator fun <ID : Any> Field<ID, Double>.plus(other: Field<ID, Long>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Double.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.plus(other: Long): Field<ID, Double> = mapValues { it + other }

    /** This value [+][Double.plus] each of [other]'s. */
    @JvmName("doublePlusFieldLong")
    public operator fun <ID : Any> Double.plus(other: Field<ID, Long>): Field<ID, Double> = other.mapValues { this + it }

    /** Each value [+][Double.plus] [other]'s. */
    @JvmName("plusFieldFloat")
    public operator fun <ID : Any> Field<ID, Double>.plus(other: Field<ID, Float>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Double.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.plus(other: Float): Field<ID, Double> = mapValues { it + other }

    /** This value [+][Double.plus] each of [other]'s. */
    @JvmName("doublePlusFieldFloat")
    public operator fun <ID : Any> Double.plus(other: Field<ID, Float>): Field<ID, Double> = other.mapValues { this + it }

    /** Each value [+][Double.plus] [other]'s. */
    @JvmName("plusFieldDouble")
    public operator fun <ID : Any> Field<ID, Double>.plus(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a + b }

    /** Each value [+][Double.plus] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.plus(other: Double): Field<ID, Double> = mapValues { it + other }

    /** This value [+][Double.plus] each of [other]'s. */
    @JvmName("doublePlusFieldDouble")
    public operator fun <ID : Any> Double.plus(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this + it }

    /** Each value [-][Double.minus] [other]'s. */
    @JvmName("minusFieldInt")
    public operator fun <ID : Any> Field<ID, Double>.minus(other: Field<ID, Int>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Double.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.minus(other: Int): Field<ID, Double> = mapValues { it - other }

    /** This value [-][Double.minus] each of [other]'s. */
    @JvmName("doubleMinusFieldInt")
    public operator fun <ID : Any> Double.minus(other: Field<ID, Int>): Field<ID, Double> = other.mapValues { this - it }

    /** Each value [-][Double.minus] [other]'s. */
    @JvmName("minusFieldLong")
    public operator fun <ID : Any> Field<ID, Double>.minus(other: Field<ID, Long>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Double.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.minus(other: Long): Field<ID, Double> = mapValues { it - other }

    /** This value [-][Double.minus] each of [other]'s. */
    @JvmName("doubleMinusFieldLong")
    public operator fun <ID : Any> Double.minus(other: Field<ID, Long>): Field<ID, Double> = other.mapValues { this - it }

    /** Each value [-][Double.minus] [other]'s. */
    @JvmName("minusFieldFloat")
    public operator fun <ID : Any> Field<ID, Double>.minus(other: Field<ID, Float>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Double.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.minus(other: Float): Field<ID, Double> = mapValues { it - other }

    /** This value [-][Double.minus] each of [other]'s. */
    @JvmName("doubleMinusFieldFloat")
    public operator fun <ID : Any> Double.minus(other: Field<ID, Float>): Field<ID, Double> = other.mapValues { this - it }

    /** Each value [-][Double.minus] [other]'s. */
    @JvmName("minusFieldDouble")
    public operator fun <ID : Any> Field<ID, Double>.minus(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a - b }

    /** Each value [-][Double.minus] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.minus(other: Double): Field<ID, Double> = mapValues { it - other }

    /** This value [-][Double.minus] each of [other]'s. */
    @JvmName("doubleMinusFieldDouble")
    public operator fun <ID : Any> Double.minus(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this - it }

    /** Each value [*][Double.times] [other]'s. */
    @JvmName("timesFieldInt")
    public operator fun <ID : Any> Field<ID, Double>.times(other: Field<ID, Int>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Double.times] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.times(other: Int): Field<ID, Double> = mapValues { it * other }

    /** This value [*][Double.times] each of [other]'s. */
    @JvmName("doubleTimesFieldInt")
    public operator fun <ID : Any> Double.times(other: Field<ID, Int>): Field<ID, Double> = other.mapValues { this * it }

    /** Each value [*][Double.times] [other]'s. */
    @JvmName("timesFieldLong")
    public operator fun <ID : Any> Field<ID, Double>.times(other: Field<ID, Long>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Double.times] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.times(other: Long): Field<ID, Double> = mapValues { it * other }

    /** This value [*][Double.times] each of [other]'s. */
    @JvmName("doubleTimesFieldLong")
    public operator fun <ID : Any> Double.times(other: Field<ID, Long>): Field<ID, Double> = other.mapValues { this * it }

    /** Each value [*][Double.times] [other]'s. */
    @JvmName("timesFieldFloat")
    public operator fun <ID : Any> Field<ID, Double>.times(other: Field<ID, Float>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Double.times] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.times(other: Float): Field<ID, Double> = mapValues { it * other }

    /** This value [*][Double.times] each of [other]'s. */
    @JvmName("doubleTimesFieldFloat")
    public operator fun <ID : Any> Double.times(other: Field<ID, Float>): Field<ID, Double> = other.mapValues { this * it }

    /** Each value [*][Double.times] [other]'s. */
    @JvmName("timesFieldDouble")
    public operator fun <ID : Any> Field<ID, Double>.times(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a * b }

    /** Each value [*][Double.times] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.times(other: Double): Field<ID, Double> = mapValues { it * other }

    /** This value [*][Double.times] each of [other]'s. */
    @JvmName("doubleTimesFieldDouble")
    public operator fun <ID : Any> Double.times(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this * it }

    /** Each value [/][Double.div] [other]'s. */
    @JvmName("divFieldInt")
    public operator fun <ID : Any> Field<ID, Double>.div(other: Field<ID, Int>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Double.div] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.div(other: Int): Field<ID, Double> = mapValues { it / other }

    /** This value [/][Double.div] each of [other]'s. */
    @JvmName("doubleDivFieldInt")
    public operator fun <ID : Any> Double.div(other: Field<ID, Int>): Field<ID, Double> = other.mapValues { this / it }

    /** Each value [/][Double.div] [other]'s. */
    @JvmName("divFieldLong")
    public operator fun <ID : Any> Field<ID, Double>.div(other: Field<ID, Long>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Double.div] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.div(other: Long): Field<ID, Double> = mapValues { it / other }

    /** This value [/][Double.div] each of [other]'s. */
    @JvmName("doubleDivFieldLong")
    public operator fun <ID : Any> Double.div(other: Field<ID, Long>): Field<ID, Double> = other.mapValues { this / it }

    /** Each value [/][Double.div] [other]'s. */
    @JvmName("divFieldFloat")
    public operator fun <ID : Any> Field<ID, Double>.div(other: Field<ID, Float>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Double.div] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.div(other: Float): Field<ID, Double> = mapValues { it / other }

    /** This value [/][Double.div] each of [other]'s. */
    @JvmName("doubleDivFieldFloat")
    public operator fun <ID : Any> Double.div(other: Field<ID, Float>): Field<ID, Double> = other.mapValues { this / it }

    /** Each value [/][Double.div] [other]'s. */
    @JvmName("divFieldDouble")
    public operator fun <ID : Any> Field<ID, Double>.div(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a / b }

    /** Each value [/][Double.div] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.div(other: Double): Field<ID, Double> = mapValues { it / other }

    /** This value [/][Double.div] each of [other]'s. */
    @JvmName("doubleDivFieldDouble")
    public operator fun <ID : Any> Double.div(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this / it }

    /** Each value [%][Double.rem] [other]'s. */
    @JvmName("remFieldInt")
    public operator fun <ID : Any> Field<ID, Double>.rem(other: Field<ID, Int>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Double.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.rem(other: Int): Field<ID, Double> = mapValues { it % other }

    /** This value [%][Double.rem] each of [other]'s. */
    @JvmName("doubleRemFieldInt")
    public operator fun <ID : Any> Double.rem(other: Field<ID, Int>): Field<ID, Double> = other.mapValues { this % it }

    /** Each value [%][Double.rem] [other]'s. */
    @JvmName("remFieldLong")
    public operator fun <ID : Any> Field<ID, Double>.rem(other: Field<ID, Long>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Double.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.rem(other: Long): Field<ID, Double> = mapValues { it % other }

    /** This value [%][Double.rem] each of [other]'s. */
    @JvmName("doubleRemFieldLong")
    public operator fun <ID : Any> Double.rem(other: Field<ID, Long>): Field<ID, Double> = other.mapValues { this % it }

    /** Each value [%][Double.rem] [other]'s. */
    @JvmName("remFieldFloat")
    public operator fun <ID : Any> Field<ID, Double>.rem(other: Field<ID, Float>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Double.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.rem(other: Float): Field<ID, Double> = mapValues { it % other }

    /** This value [%][Double.rem] each of [other]'s. */
    @JvmName("doubleRemFieldFloat")
    public operator fun <ID : Any> Double.rem(other: Field<ID, Float>): Field<ID, Double> = other.mapValues { this % it }

    /** Each value [%][Double.rem] [other]'s. */
    @JvmName("remFieldDouble")
    public operator fun <ID : Any> Field<ID, Double>.rem(other: Field<ID, Double>): Field<ID, Double> =
        alignedMapValues(other) { a, b -> a % b }

    /** Each value [%][Double.rem] [other]. */
    public operator fun <ID : Any> Field<ID, Double>.rem(other: Double): Field<ID, Double> = mapValues { it % other }

    /** This value [%][Double.rem] each of [other]'s. */
    @JvmName("doubleRemFieldDouble")
    public operator fun <ID : Any> Double.rem(other: Field<ID, Double>): Field<ID, Double> = other.mapValues { this % it }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldInt")
    public fun <ID : Any> Field<ID, Double>.compareTo(other: Field<ID, Int>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Double>.compareTo(other: Int): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldLong")
    public fun <ID : Any> Field<ID, Double>.compareTo(other: Field<ID, Long>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Double>.compareTo(other: Long): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldFloat")
    public fun <ID : Any> Field<ID, Double>.compareTo(other: Field<ID, Float>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Double>.compareTo(other: Float): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** How each value compares with [other]'s: negative when it is less, 0 when equal, positive when greater. */
    @JvmName("compareToFieldDouble")
    public fun <ID : Any> Field<ID, Double>.compareTo(other: Field<ID, Double>): Field<ID, Int> =
        alignedMapValues(other) { a, b -> a.compareTo(b) }

    /** How each value compares with [other]: negative when it is less, 0 when equal, positive when greater. */
    public fun <ID : Any> Field<ID, Double>.compareTo(other: Double): Field<ID, Int> = mapValues { it.compareTo(other) }

    /** Each value, negated. */
    public operator fun <ID : Any> Field<ID, Double>.unaryMinus(): Field<ID, Double> = mapValues { -it }

    /** Each value as it is. */
    public operator fun <ID : Any> Field<ID, Double>.unaryPlus(): Field<ID, Double> = this

    /** Each value plus 1. */
    public operator fun <ID : Any> Field<ID, Double>.inc(): Field<ID, Double> = mapValues { it.inc() }

    /** Each value minus 1. */
    public operator fun <ID : Any> Field<ID, Double>.dec(): Field<ID, Double> = mapValues { it.dec() }

    /** Each value, converted by [Double.toInt]. */
    public fun <ID : Any> Field<ID, Double>.toInt(): Field<ID, Int> = mapValues { it.toInt() }

    /** Each value, converted by [Double.toLong]. */
    public fun <ID : Any> Field<ID, Double>.toLong(): Field<ID, Long> = mapValues { it.toLong() }

    /** Each value, converted by [Double.toFloat]. */
    public fun <ID : Any> Field<ID, Double>.toFloat(): Field<ID, Float> = mapValues { it.toFloat() }
}
