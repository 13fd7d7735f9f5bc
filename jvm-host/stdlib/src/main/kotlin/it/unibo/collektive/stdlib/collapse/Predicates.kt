package it.unibo.collektive.stdlib.collapse

import it.unibo.collektive.aggregate.Collapse

/** Returns whether [predicate] holds for all elements, which is `true` without elements. */
public inline fun <E> Collapse<E>.all(predicate: (E) -> Boolean): Boolean = list.all(predicate)

/** Returns whether [predicate] holds for at least one element. */
public inline fun <E> Collapse<E>.any(predicate: (E) -> Boolean): Boolean = list.any(predicate)

/** Returns whether [predicate] holds for no element. */
public inline fun <E> Collapse<E>.none(predicate: (E) -> Boolean): Boolean = list.none(predicate)

/** Whether all elements are `true`, which is the case without elements. */
public val Collapse<Boolean>.all: Boolean get() = all { it }

/** Whether at least one element is `true`. */
public val Collapse<Boolean>.any: Boolean get() = any { it }

/** Whether no element is `true`. */
public val Collapse<Boolean>.none: Boolean get() = none { it }

/** Returns the number of elements for which [predicate] holds. */
public inline fun <E> Collapse<E>.countMatching(predicate: (E) -> Boolean): Int = list.count(predicate)
