package it.unibo.collektive.stdlib.collapse

import it.unibo.collektive.aggregate.CollapseAll
import it.unibo.collektive.aggregate.CollapseNeighbors
import it.unibo.collektive.aggregate.FieldEntry

// On ties the first entry in the field's order wins: the neighbour with the lowest id, the device itself last.

/** The neighbour with the greatest value; `null` without neighbours. */
public fun <ID : Any, T : Comparable<T>> CollapseNeighbors<FieldEntry<ID, T>>.idOfMax(): ID? = maxBy { it.value }?.id

/** The neighbour whose entry's [selector] is greatest; `null` without neighbours. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseNeighbors<FieldEntry<ID, T>>.idOfMaxBy(
    selector: (FieldEntry<ID, T>) -> C,
): ID? = maxBy(selector)?.id

/** The device whose entry's [selector] is greatest. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseAll<FieldEntry<ID, T>>.idOfMaxBy(selector: (FieldEntry<ID, T>) -> C): ID =
    maxBy(selector).id

/** The neighbour whose entry is greatest in the order of [comparator]; `null` without neighbours. */
public fun <ID : Any, T> CollapseNeighbors<FieldEntry<ID, T>>.idOfMaxWith(comparator: Comparator<FieldEntry<ID, T>>): ID? =
    maxWith(comparator)?.id

/** The device whose entry is greatest in the order of [comparator]. */
public fun <ID : Any, T> CollapseAll<FieldEntry<ID, T>>.idOfMaxWith(comparator: Comparator<FieldEntry<ID, T>>): ID = maxWith(comparator).id

/** The value of the neighbour's entry whose [selector] is greatest; `null` without neighbours. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseNeighbors<FieldEntry<ID, T>>.valueOfMaxBy(
    selector: (FieldEntry<ID, T>) -> C,
): T? = maxBy(selector)?.value

/** The value of the entry whose [selector] is greatest. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseAll<FieldEntry<ID, T>>.valueOfMaxBy(selector: (FieldEntry<ID, T>) -> C): T =
    maxBy(selector).value

/** The value of the neighbour's entry that is greatest in the order of [comparator]; `null` without neighbours. */
public fun <ID : Any, T> CollapseNeighbors<FieldEntry<ID, T>>.valueOfMaxWith(comparator: Comparator<FieldEntry<ID, T>>): T? =
    maxWith(comparator)?.value

/** The value of the entry that is greatest in the order of [comparator]. */
public fun <ID : Any, T> CollapseAll<FieldEntry<ID, T>>.valueOfMaxWith(comparator: Comparator<FieldEntry<ID, T>>): T =
    maxWith(comparator).value

/** The neighbour with the least value; `null` without neighbours. */
public fun <ID : Any, T : Comparable<T>> CollapseNeighbors<FieldEntry<ID, T>>.idOfMin(): ID? = minBy { it.value }?.id

/** The neighbour whose entry's [selector] is least; `null` without neighbours. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseNeighbors<FieldEntry<ID, T>>.idOfMinBy(
    selector: (FieldEntry<ID, T>) -> C,
): ID? = minBy(selector)?.id

/** The device whose entry's [selector] is least. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseAll<FieldEntry<ID, T>>.idOfMinBy(selector: (FieldEntry<ID, T>) -> C): ID =
    minBy(selector).id

/** The neighbour whose entry is least in the order of [comparator]; `null` without neighbours. */
public fun <ID : Any, T> CollapseNeighbors<FieldEntry<ID, T>>.idOfMinWith(comparator: Comparator<FieldEntry<ID, T>>): ID? =
    minWith(comparator)?.id

/** The device whose entry is least in the order of [comparator]. */
public fun <ID : Any, T> CollapseAll<FieldEntry<ID, T>>.idOfMinWith(comparator: Comparator<FieldEntry<ID, T>>): ID = minWith(comparator).id

/** The value of the neighbour's entry whose [selector] is least; `null` without neighbours. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseNeighbors<FieldEntry<ID, T>>.valueOfMinBy(
    selector: (FieldEntry<ID, T>) -> C,
): T? = minBy(selector)?.value

/** The value of the entry whose [selector] is least. */
public inline fun <ID : Any, T, C : Comparable<C>> CollapseAll<FieldEntry<ID, T>>.valueOfMinBy(selector: (FieldEntry<ID, T>) -> C): T =
    minBy(selector).value

/** The value of the neighbour's entry that is least in the order of [comparator]; `null` without neighbours. */
public fun <ID : Any, T> CollapseNeighbors<FieldEntry<ID, T>>.valueOfMinWith(comparator: Comparator<FieldEntry<ID, T>>): T? =
    minWith(comparator)?.value

/** The value of the entry that is least in the order of [comparator]. */
public fun <ID : Any, T> CollapseAll<FieldEntry<ID, T>>.valueOfMinWith(comparator: Comparator<FieldEntry<ID, T>>): T =
    minWith(comparator).value
