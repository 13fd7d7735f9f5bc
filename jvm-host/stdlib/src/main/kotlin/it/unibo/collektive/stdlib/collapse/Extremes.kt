package it.unibo.collektive.stdlib.collapse

import arrow.core.None
import arrow.core.Option
import arrow.core.Some
import it.unibo.collektive.aggregate.Collapse
import it.unibo.collektive.aggregate.CollapseAll
import it.unibo.collektive.aggregate.CollapseNeighbors

// If several elements are equal, the first one in the field's order wins: the neighbour with the lowest id, and the device itself last.

/** Returns the greatest of the neighbours' elements, or `null` without neighbours. */
public fun <E : Comparable<E>> CollapseNeighbors<E>.max(): E? = list.maxOrNull()

/** Returns the greatest of the neighbours' elements, or `Int.MIN_VALUE` without neighbours. */
@JvmName("maxOfInt")
public fun CollapseNeighbors<Int>.max(): Int = max(Int.MIN_VALUE)

/** Returns the greatest of the neighbours' elements, or `Double.NEGATIVE_INFINITY` without neighbours. */
@JvmName("maxOfDouble")
public fun CollapseNeighbors<Double>.max(): Double = max(Double.NEGATIVE_INFINITY)

/** Returns the greatest element. */
public fun <E : Comparable<E>> CollapseAll<E>.max(): E = list.max()

/** Returns the greatest of the elements and [base]. */
public fun <E : Comparable<E>> Collapse<E>.max(base: E): E = list.fold(base) { best, element -> maxOf(best, element) }

/** Returns the neighbours' element for which [selector] returns the greatest result, or `null` without neighbours. */
public inline fun <E : Any, C : Comparable<C>> CollapseNeighbors<E>.maxBy(selector: (E) -> C): E? = list.maxByOrNull(selector)

/** Returns the neighbours' element, which may be `null`, for which [selector] returns the greatest result, or [None] without neighbours. */
@JvmName("maxByOption")
public inline fun <E, C : Comparable<C>> CollapseNeighbors<E>.maxBy(selector: (E) -> C): Option<E?> =
    if (size == 0) None else Some(list.maxBy(selector))

/** Returns the element for which [selector] returns the greatest result. */
public inline fun <E, C : Comparable<C>> CollapseAll<E>.maxBy(selector: (E) -> C): E = list.maxBy(selector)

/** Returns the greatest of the neighbours' elements by [comparator], or `null` without neighbours. */
public fun <E : Any> CollapseNeighbors<E>.maxWith(comparator: Comparator<in E>): E? = list.maxWithOrNull(comparator)

/** Returns the greatest of the neighbours' elements, which may be `null`, by [comparator], or [None] without neighbours. */
@JvmName("maxWithOption")
public fun <E> CollapseNeighbors<E>.maxWith(comparator: Comparator<in E>): Option<E?> =
    if (size == 0) None else Some(list.maxWith(comparator))

/** Returns the greatest element by [comparator]. */
public fun <E> CollapseAll<E>.maxWith(comparator: Comparator<in E>): E = list.maxWith(comparator)

/** Returns the least of the neighbours' elements, or `null` without neighbours. */
public fun <E : Comparable<E>> CollapseNeighbors<E>.min(): E? = list.minOrNull()

/** Returns the least of the neighbours' elements, or `Int.MAX_VALUE` without neighbours. */
@JvmName("minOfInt")
public fun CollapseNeighbors<Int>.min(): Int = min(Int.MAX_VALUE)

/** Returns the least of the neighbours' elements, or `Double.POSITIVE_INFINITY` without neighbours. */
@JvmName("minOfDouble")
public fun CollapseNeighbors<Double>.min(): Double = min(Double.POSITIVE_INFINITY)

/** Returns the least element. */
public fun <E : Comparable<E>> CollapseAll<E>.min(): E = list.min()

/** Returns the least of the elements and [base]. */
public fun <E : Comparable<E>> Collapse<E>.min(base: E): E = list.fold(base) { best, element -> minOf(best, element) }

/** Returns the neighbours' element for which [selector] returns the least result, or `null` without neighbours. */
public inline fun <E : Any, C : Comparable<C>> CollapseNeighbors<E>.minBy(selector: (E) -> C): E? = list.minByOrNull(selector)

/** Returns the neighbours' element, which may be `null`, for which [selector] returns the least result, or [None] without neighbours. */
@JvmName("minByOption")
public inline fun <E, C : Comparable<C>> CollapseNeighbors<E>.minBy(selector: (E) -> C): Option<E?> =
    if (size == 0) None else Some(list.minBy(selector))

/** Returns the element for which [selector] returns the least result. */
public inline fun <E, C : Comparable<C>> CollapseAll<E>.minBy(selector: (E) -> C): E = list.minBy(selector)

/** Returns the least of the neighbours' elements by [comparator], or `null` without neighbours. */
public fun <E : Any> CollapseNeighbors<E>.minWith(comparator: Comparator<in E>): E? = list.minWithOrNull(comparator)

/** Returns the least of the neighbours' elements, which may be `null`, by [comparator], or [None] without neighbours. */
@JvmName("minWithOption")
public fun <E> CollapseNeighbors<E>.minWith(comparator: Comparator<in E>): Option<E?> =
    if (size == 0) None else Some(list.minWith(comparator))

/** Returns the least element by [comparator]. */
public fun <E> CollapseAll<E>.minWith(comparator: Comparator<in E>): E = list.minWith(comparator)
