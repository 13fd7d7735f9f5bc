package it.unibo.collektive.stdlib.util

/**
 * Returns whether this value and [other] are interchangeable: the same object, or equal values of a built-in type. The `equals` of other
 * classes may ignore a difference.
 */
internal fun Any?.isSameAs(other: Any?): Boolean =
    this === other || (this is Number || this is String || this is Boolean || this is Char) && this == other
