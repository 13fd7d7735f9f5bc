@file:CollektiveIgnore("aligns itself")
@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib.accumulation

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.Aggregate.Companion.dataSharingMethod
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.DataSharingMethod
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.stdlib.collapse.minWith
import it.unibo.collektive.stdlib.util.aligned

/**
 * Returns the id of the device with the least entry of [potential] by [comparator].
 *
 * This is the next device downhill, or this device itself at a minimum. If several entries are equal, the neighbour with the lowest id
 * wins, and this device comes last. Two devices of equal potential may therefore choose each other.
 */
@Suppress("UnusedReceiverParameter")
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.findParent(
    potential: Field<ID, P>,
    comparator: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): ID = potential.all.minWith(comparator).id

/** Runs [findParent] with this device's [potential] and the potentials that its neighbours had in their last rounds. */
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.findParent(
    potential: P,
    comparator: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): ID = findParent(potentialField(potential, dataSharingMethod<P>()), comparator)

/** Returns the ids of the neighbours whose entries satisfy [isParent] in ascending order. By default, these are the neighbours downhill. */
@Suppress("UnusedReceiverParameter")
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.findParents(
    potential: Field<ID, P>,
    isParent: (FieldEntry<ID, P>) -> Boolean = { it.value < potential.local.value },
): Set<ID> = potential.neighbors.list.filter(isParent).mapTo(LinkedHashSet()) { it.id }

/** Runs [findParents] with this device's [potential] and the potentials that its neighbours had in their last rounds. */
public inline fun <reified ID : Any, reified P : Comparable<P>> Aggregate<ID>.findParents(
    potential: P,
    isParent: (FieldEntry<ID, P>) -> Boolean = { it.value < potential },
): Set<ID> = findParents(potentialField(potential, dataSharingMethod<P>()), isParent)

@PublishedApi
internal fun <ID : Any, P> Aggregate<ID>.potentialField(potential: P, sharing: DataSharingMethod<P>): Field<ID, P> =
    aligned("potential") { neighboring(potential, sharing) }
