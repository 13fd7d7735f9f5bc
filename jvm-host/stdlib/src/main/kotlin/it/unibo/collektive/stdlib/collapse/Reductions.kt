package it.unibo.collektive.stdlib.collapse

import arrow.core.None
import arrow.core.Option
import arrow.core.Some
import it.unibo.collektive.aggregate.Collapse
import it.unibo.collektive.aggregate.CollapseAll
import it.unibo.collektive.aggregate.CollapseNeighbors
import it.unibo.collektive.stdlib.util.Accumulator
import it.unibo.collektive.stdlib.util.Reducer

/** Starts from [initial] and applies [accumulator] to the elements one by one. */
public inline fun <R, E> Collapse<E>.fold(initial: R, accumulator: Accumulator<R, E>): R = list.fold(initial, accumulator)

/** Starts from the first of the neighbours' elements and applies [reducer] to the others one by one; `null` without neighbours. */
public inline fun <E : Any> CollapseNeighbors<E>.reduce(reducer: Reducer<E>): E? = list.reduceOrNull(reducer)

/** [reduce] of elements that may be `null`; [None] without neighbours. */
@JvmName("reduceOption")
public inline fun <E> CollapseNeighbors<E>.reduce(reducer: Reducer<E>): Option<E?> = if (size == 0) None else Some(list.reduce(reducer))

/** Starts from the first element and applies [reducer] to the others one by one. */
public inline fun <E> CollapseAll<E>.reduce(reducer: Reducer<E>): E = list.reduce(reducer)

/** The sum of the elements, or 0 if empty; overflows silently. */
@JvmName("sumOfInt")
public fun Collapse<Int>.sum(): Int = list.sum()

/** The sum of the elements in their order, or 0.0 if empty. */
@JvmName("sumOfDouble")
public fun Collapse<Double>.sum(): Double = list.sum()

/** The product of the elements, or 1 if empty; overflows silently. */
@JvmName("productOfInt")
public fun Collapse<Int>.product(): Int = list.fold(1, Int::times)

/** The product of the elements in their order, or 1.0 if empty. */
@JvmName("productOfDouble")
public fun Collapse<Double>.product(): Double = list.fold(1.0, Double::times)
