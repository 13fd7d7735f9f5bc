package it.unibo.collektive.stdlib.util

/** The sum, saturated at the range of [Int]; so `Int.MAX_VALUE` can serve as infinity. */
public fun Int.nonOverflowingPlus(other: Int): Int = (toLong() + other).coerceIn(Int.MIN_VALUE.toLong(), Int.MAX_VALUE.toLong()).toInt()
