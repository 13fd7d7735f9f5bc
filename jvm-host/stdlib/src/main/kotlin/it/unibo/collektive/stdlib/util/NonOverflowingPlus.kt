package it.unibo.collektive.stdlib.util

/** The sum, or the [Int] nearest to it where it does not fit: `Int.MAX_VALUE` serves as infinity. */
public fun Int.nonOverflowingPlus(other: Int): Int =
    (toLong() + other).coerceIn(Int.MIN_VALUE.toLong(), Int.MAX_VALUE.toLong()).toInt()
