package it.unibo.collektive.stdlib.collapse

import it.unibo.collektive.aggregate.Collapse

/** Whether [predicate] holds for each element; `true` if empty. */
public inline fun <E> Collapse<E>.all(predicate: (E) -> Boolean): Boolean = list.all(predicate)

/** Whether [predicate] holds for at least one element. */
public inline fun <E> Collapse<E>.any(predicate: (E) -> Boolean): Boolean = list.any(predicate)

/** Whether [predicate] holds for no element. */
public inline fun <E> Collapse<E>.none(predicate: (E) -> Boolean): Boolean = list.none(predicate)

/** Whether each element is `true`; `true` if empty. */
public val Collapse<Boolean>.all: Boolean get() = all { it }

/** Whether at least one element is `true`. */
public val Collapse<Boolean>.any: Boolean get() = any { it }

/** Whether no element is `true`. */
public val Collapse<Boolean>.none: Boolean get() = none { it }

/** The number of elements for which [predicate] holds. */
public inline fun <E> Collapse<E>.countMatching(predicate: (E) -> Boolean): Int = list.count(predicate)
