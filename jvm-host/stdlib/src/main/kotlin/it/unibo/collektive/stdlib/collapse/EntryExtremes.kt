package it.unibo.collektive.stdlib.collapse

import it.unibo.collektive.aggregate.CollapseAll
import it.unibo.collektive.aggregate.CollapseNeighbors
import it.unibo.collektive.aggregate.FieldEntry

// If several entries are equal, the first one in the field's order wins: the neighbour with the lowest id, and the device itself last.

/** Returns the id of the neighbour with the greatest value, or `null` without neighbours. */
public fun <ID : Any, T : Comparable<T>> CollapseNeighbors<FieldEntry<ID, T>>.idOfMax(): ID? = maxBy { it.value }?.id

/** Returns the id of the neighbour for whose entry [selector] returns the greatest result, or `null` without neighbours. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseNeighbors<FieldEntry<ID, T>>.idOfMaxBy(
    selector: (FieldEntry<ID, T>) -> C,
): ID? = maxBy(selector)?.id

/** Returns the id of the device for whose entry [selector] returns the greatest result. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseAll<FieldEntry<ID, T>>.idOfMaxBy(selector: (FieldEntry<ID, T>) -> C): ID =
    maxBy(selector).id

/** Returns the id of the neighbour whose entry is the greatest by [comparator], or `null` without neighbours. */
public fun <ID : Any, T> CollapseNeighbors<FieldEntry<ID, T>>.idOfMaxWith(comparator: Comparator<FieldEntry<ID, T>>): ID? =
    maxWith(comparator)?.id

/** Returns the id of the device whose entry is the greatest by [comparator]. */
public fun <ID : Any, T> CollapseAll<FieldEntry<ID, T>>.idOfMaxWith(comparator: Comparator<FieldEntry<ID, T>>): ID = maxWith(comparator).id

/** Returns the value of the neighbour for whose entry [selector] returns the greatest result, or `null` without neighbours. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseNeighbors<FieldEntry<ID, T>>.valueOfMaxBy(
    selector: (FieldEntry<ID, T>) -> C,
): T? = maxBy(selector)?.value

/** Returns the value of the device for whose entry [selector] returns the greatest result. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseAll<FieldEntry<ID, T>>.valueOfMaxBy(selector: (FieldEntry<ID, T>) -> C): T =
    maxBy(selector).value

/** Returns the value of the neighbour whose entry is the greatest by [comparator], or `null` without neighbours. */
public fun <ID : Any, T> CollapseNeighbors<FieldEntry<ID, T>>.valueOfMaxWith(comparator: Comparator<FieldEntry<ID, T>>): T? =
    maxWith(comparator)?.value

/** Returns the value of the device whose entry is the greatest by [comparator]. */
public fun <ID : Any, T> CollapseAll<FieldEntry<ID, T>>.valueOfMaxWith(comparator: Comparator<FieldEntry<ID, T>>): T =
    maxWith(comparator).value

/** Returns the id of the neighbour with the least value, or `null` without neighbours. */
public fun <ID : Any, T : Comparable<T>> CollapseNeighbors<FieldEntry<ID, T>>.idOfMin(): ID? = minBy { it.value }?.id

/** Returns the id of the neighbour for whose entry [selector] returns the least result, or `null` without neighbours. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseNeighbors<FieldEntry<ID, T>>.idOfMinBy(
    selector: (FieldEntry<ID, T>) -> C,
): ID? = minBy(selector)?.id

/** Returns the id of the device for whose entry [selector] returns the least result. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseAll<FieldEntry<ID, T>>.idOfMinBy(selector: (FieldEntry<ID, T>) -> C): ID =
    minBy(selector).id

/** Returns the id of the neighbour whose entry is the least by [comparator], or `null` without neighbours. */
public fun <ID : Any, T> CollapseNeighbors<FieldEntry<ID, T>>.idOfMinWith(comparator: Comparator<FieldEntry<ID, T>>): ID? =
    minWith(comparator)?.id

/** Returns the id of the device whose entry is the least by [comparator]. */
public fun <ID : Any, T> CollapseAll<FieldEntry<ID, T>>.idOfMinWith(comparator: Comparator<FieldEntry<ID, T>>): ID = minWith(comparator).id

/** Returns the value of the neighbour for whose entry [selector] returns the least result, or `null` without neighbours. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseNeighbors<FieldEntry<ID, T>>.valueOfMinBy(
    selector: (FieldEntry<ID, T>) -> C,
): T? = minBy(selector)?.value

/** Returns the value of the device for whose entry [selector] returns the least result. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseAll<FieldEntry<ID, T>>.valueOfMinBy(selector: (FieldEntry<ID, T>) -> C): T =
    minBy(selector).value

/** Returns the value of the neighbour whose entry is the least by [comparator], or `null` without neighbours. */
public fun <ID : Any, T> CollapseNeighbors<FieldEntry<ID, T>>.valueOfMinWith(comparator: Comparator<FieldEntry<ID, T>>): T? =
    minWith(comparator)?.value

/** Returns the value of the device whose entry is the least by [comparator]. */
public fun <ID : Any, T> CollapseAll<FieldEntry<ID, T>>.valueOfMinWith(comparator: Comparator<FieldEntry<ID, T>>): T =
    minWith(comparator).value
