package it.unibo.collektive.stdlib.collapse

import it.unibo.collektive.aggregate.Collapse
import it.unibo.collektive.aggregate.CollapseAll
import it.unibo.collektive.aggregate.CollapseNeighbors

/** Starts from [base] and applies [accumulate] to the elements one by one. */
public inline fun <E, R> Collapse<E>.fold(base: R, accumulate: (R, E) -> R): R = list.fold(base, accumulate)

/** Starts from the first of the neighbours' elements and applies [accumulate] to the others one by one; `null` when there are none. */
public inline fun <E> CollapseNeighbors<E>.reduce(accumulate: (E, E) -> E): E? = list.reduceOrNull(accumulate)

/** Starts from the first element and applies [accumulate] to the others one by one. */
public inline fun <E> CollapseAll<E>.reduce(accumulate: (E, E) -> E): E = list.reduce(accumulate)

/** The sum of the elements, 0 when there are none; overflows silently. */
@JvmName("sumOfInt")
public fun Collapse<Int>.sum(): Int = list.sum()

/** The sum of the elements in their order, 0.0 when there are none. */
@JvmName("sumOfDouble")
public fun Collapse<Double>.sum(): Double = list.sum()

/** The product of the elements, 1 when there are none; overflows silently. */
@JvmName("productOfInt")
public fun Collapse<Int>.product(): Int = list.fold(1, Int::times)

/** The product of the elements in their order, 1.0 when there are none. */
@JvmName("productOfDouble")
public fun Collapse<Double>.product(): Double = list.fold(1.0, Double::times)
