package it.unibo.collektive.stdlib.util

/** Returns the sum, limited to the range of [Int], so `Int.MAX_VALUE` can represent infinity. */
public fun Int.nonOverflowingPlus(other: Int): Int = (toLong() + other).coerceIn(Int.MIN_VALUE.toLong(), Int.MAX_VALUE.toLong()).toInt()
