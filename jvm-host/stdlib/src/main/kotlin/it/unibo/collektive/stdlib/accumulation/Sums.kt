@file:CollektiveIgnore("aligns itself")

package it.unibo.collektive.stdlib.accumulation

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.stdlib.spreading.hopDistanceTo

/** Returns the sum of [local] over this device and its descendants in the tree of [convergeCast]. */
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.convergeSum(
    local: Int,
    potential: Field<ID, P>,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): Int = convergeCast(local, potential, selectParent, Int::plus)

/** Returns the sum of [local] over this device and its descendants in the tree of [convergeCast]. */
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.convergeSum(
    local: Int,
    potential: P,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): Int = convergeCast(local, potential, selectParent, Int::plus)

/** Returns the sum of [local] over this device and its descendants in the tree towards the nearest [sink]. */
public inline fun <reified ID : Any> Aggregate<ID>.convergeSum(local: Int, sink: Boolean): Int = convergeCast(local, sink, Int::plus)

/** Returns the sum of [local] over this device and its descendants in the tree of [convergeCast]. */
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.convergeSum(
    local: Double,
    potential: Field<ID, P>,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): Double = convergeCast(local, potential, selectParent, Double::plus)

/** Returns the sum of [local] over this device and its descendants in the tree of [convergeCast]. */
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.convergeSum(
    local: Double,
    potential: P,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): Double = convergeCast(local, potential, selectParent, Double::plus)

/** Returns the sum of [local] over this device and its descendants in the tree towards the nearest [sink]. */
public inline fun <reified ID : Any> Aggregate<ID>.convergeSum(local: Double, sink: Boolean): Double =
    convergeCast(local, sink, Double::plus)

/** Returns the mean of [local] over this device and its descendants in the tree of [convergeCast]. */
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.convergeMean(
    local: Double,
    potential: Field<ID, P>,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): Double = convergeCast(local to 1, potential, selectParent, ::addPairs).let { (sum, count) -> sum / count }

/** Returns the mean of [local] over this device and its descendants in the tree of [convergeCast]. */
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.convergeMean(
    local: Double,
    potential: P,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): Double = convergeCast(local to 1, potential, selectParent, ::addPairs).let { (sum, count) -> sum / count }

/** Returns the mean of [local] over this device and its descendants in the tree towards the nearest [sink]. */
public inline fun <reified ID : Any> Aggregate<ID>.convergeMean(local: Double, sink: Boolean): Double =
    convergeMean(local, hopDistanceTo(sink))

/** Returns the number of descendants in the tree of [convergeCast], including this device. */
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.countDevices(
    potential: Field<ID, P>,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): Int = convergeSum(1, potential, selectParent)

/** Returns the number of descendants in the tree of [convergeCast], including this device. */
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.countDevices(
    potential: P,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): Int = convergeSum(1, potential, selectParent)

/** Returns the number of descendants in the tree towards the nearest [sink], including this device. */
public inline fun <reified ID : Any> Aggregate<ID>.countDevices(sink: Boolean): Int = convergeSum(1, sink)

@PublishedApi
internal fun addPairs(a: Pair<Double, Int>, b: Pair<Double, Int>): Pair<Double, Int> = a.first + b.first to a.second + b.second
