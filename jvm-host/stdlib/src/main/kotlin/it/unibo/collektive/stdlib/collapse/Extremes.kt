package it.unibo.collektive.stdlib.collapse

import arrow.core.None
import arrow.core.Option
import arrow.core.Some
import it.unibo.collektive.aggregate.Collapse
import it.unibo.collektive.aggregate.CollapseAll
import it.unibo.collektive.aggregate.CollapseNeighbors

// On ties the first element in the field's order wins: the neighbour with the lowest id, the device itself last.

/** The greatest of the neighbours' elements; `null` without neighbours. */
public fun <E : Comparable<E>> CollapseNeighbors<E>.max(): E? = list.maxOrNull()

/** The greatest of the neighbours' elements; `Int.MIN_VALUE` without neighbours. */
@JvmName("maxOfInt")
public fun CollapseNeighbors<Int>.max(): Int = max(Int.MIN_VALUE)

/** The greatest of the neighbours' elements; `Double.NEGATIVE_INFINITY` without neighbours. */
@JvmName("maxOfDouble")
public fun CollapseNeighbors<Double>.max(): Double = max(Double.NEGATIVE_INFINITY)

/** The greatest element. */
public fun <E : Comparable<E>> CollapseAll<E>.max(): E = list.max()

/** The greatest of the elements and [base]. */
public fun <E : Comparable<E>> Collapse<E>.max(base: E): E = list.fold(base) { best, element -> maxOf(best, element) }

/** The neighbours' element whose [selector] is greatest; `null` without neighbours. */
public inline fun <E : Any, C : Comparable<C>> CollapseNeighbors<E>.maxBy(selector: (E) -> C): E? = list.maxByOrNull(selector)

/** The neighbours' element (possibly `null`) with the greatest [selector]; [None] without neighbours. */
@JvmName("maxByOption")
public inline fun <E, C : Comparable<C>> CollapseNeighbors<E>.maxBy(selector: (E) -> C): Option<E?> =
    if (size == 0) None else Some(list.maxBy(selector))

/** The element whose [selector] is greatest. */
public inline fun <E, C : Comparable<C>> CollapseAll<E>.maxBy(selector: (E) -> C): E = list.maxBy(selector)

/** The greatest of the neighbours' elements in the order of [comparator]; `null` without neighbours. */
public fun <E : Any> CollapseNeighbors<E>.maxWith(comparator: Comparator<in E>): E? = list.maxWithOrNull(comparator)

/** The greatest of the neighbours' elements, which may be `null`, in the order of [comparator]; [None] without neighbours. */
@JvmName("maxWithOption")
public fun <E> CollapseNeighbors<E>.maxWith(comparator: Comparator<in E>): Option<E?> =
    if (size == 0) None else Some(list.maxWith(comparator))

/** The greatest element in the order of [comparator]. */
public fun <E> CollapseAll<E>.maxWith(comparator: Comparator<in E>): E = list.maxWith(comparator)

/** The least of the neighbours' elements; `null` without neighbours. */
public fun <E : Comparable<E>> CollapseNeighbors<E>.min(): E? = list.minOrNull()

/** The least of the neighbours' elements; `Int.MAX_VALUE` without neighbours. */
@JvmName("minOfInt")
public fun CollapseNeighbors<Int>.min(): Int = min(Int.MAX_VALUE)

/** The least of the neighbours' elements; `Double.POSITIVE_INFINITY` without neighbours. */
@JvmName("minOfDouble")
public fun CollapseNeighbors<Double>.min(): Double = min(Double.POSITIVE_INFINITY)

/** The least element. */
public fun <E : Comparable<E>> CollapseAll<E>.min(): E = list.min()

/** The least of the elements and [base]. */
public fun <E : Comparable<E>> Collapse<E>.min(base: E): E = list.fold(base) { best, element -> minOf(best, element) }

/** The neighbours' element whose [selector] is least; `null` without neighbours. */
public inline fun <E : Any, C : Comparable<C>> CollapseNeighbors<E>.minBy(selector: (E) -> C): E? = list.minByOrNull(selector)

/** The neighbours' element (possibly `null`) with the least [selector]; [None] without neighbours. */
@JvmName("minByOption")
public inline fun <E, C : Comparable<C>> CollapseNeighbors<E>.minBy(selector: (E) -> C): Option<E?> =
    if (size == 0) None else Some(list.minBy(selector))

/** The element whose [selector] is least. */
public inline fun <E, C : Comparable<C>> CollapseAll<E>.minBy(selector: (E) -> C): E = list.minBy(selector)

/** The least of the neighbours' elements in the order of [comparator]; `null` without neighbours. */
public fun <E : Any> CollapseNeighbors<E>.minWith(comparator: Comparator<in E>): E? = list.minWithOrNull(comparator)

/** The least of the neighbours' elements, which may be `null`, in the order of [comparator]; [None] without neighbours. */
@JvmName("minWithOption")
public fun <E> CollapseNeighbors<E>.minWith(comparator: Comparator<in E>): Option<E?> =
    if (size == 0) None else Some(list.minWith(comparator))

/** The least element in the order of [comparator]. */
public fun <E> CollapseAll<E>.minWith(comparator: Comparator<in E>): E = list.minWith(comparator)
