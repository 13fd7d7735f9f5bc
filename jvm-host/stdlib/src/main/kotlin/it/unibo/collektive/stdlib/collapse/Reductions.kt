package it.unibo.collektive.stdlib.collapse

import arrow.core.None
import arrow.core.Option
import arrow.core.Some
import it.unibo.collektive.aggregate.Collapse
import it.unibo.collektive.aggregate.CollapseAll
import it.unibo.collektive.aggregate.CollapseNeighbors
import it.unibo.collektive.stdlib.util.Accumulator
import it.unibo.collektive.stdlib.util.Reducer

/** Accumulates the elements one by one with [accumulator], beginning with [initial]. */
public inline fun <R, E> Collapse<E>.fold(initial: R, accumulator: Accumulator<R, E>): R = list.fold(initial, accumulator)

/** Reduces the neighbours' elements to one with [reducer], in their order, or returns `null` without neighbours. */
public inline fun <E : Any> CollapseNeighbors<E>.reduce(reducer: Reducer<E>): E? = list.reduceOrNull(reducer)

/** Reduces the neighbours' elements, which may be `null`, to one with [reducer], or returns [None] without neighbours. */
@JvmName("reduceOption")
public inline fun <E> CollapseNeighbors<E>.reduce(reducer: Reducer<E>): Option<E?> = if (size == 0) None else Some(list.reduce(reducer))

/** Reduces the elements to one with [reducer], in their order. */
public inline fun <E> CollapseAll<E>.reduce(reducer: Reducer<E>): E = list.reduce(reducer)

/** Returns the sum of the elements, or 0 without elements. Overflow is not detected. */
@JvmName("sumOfInt")
public fun Collapse<Int>.sum(): Int = list.sum()

/** Returns the sum of the elements, computed in their order, or 0.0 without elements. */
@JvmName("sumOfDouble")
public fun Collapse<Double>.sum(): Double = list.sum()

/** Returns the product of the elements, or 1 without elements. Overflow is not detected. */
@JvmName("productOfInt")
public fun Collapse<Int>.product(): Int = list.fold(1, Int::times)

/** Returns the product of the elements, computed in their order, or 1.0 without elements. */
@JvmName("productOfDouble")
public fun Collapse<Double>.product(): Double = list.fold(1.0, Double::times)
