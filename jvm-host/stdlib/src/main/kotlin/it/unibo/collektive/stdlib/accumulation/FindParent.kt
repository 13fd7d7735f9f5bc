@file:CollektiveIgnore("uses no primitives")

package it.unibo.collektive.stdlib.accumulation

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore

/**
 * The id of the least entry of [potential] by [selectParent]: the next device downhill, or this device at the bottom. On ties this
 * device wins, then the lower id, so that two devices of equal potential never choose each other.
 */
@Suppress("UnusedReceiverParameter")
public fun <ID : Any, P : Comparable<P>> Aggregate<ID>.findParent(
    potential: Field<ID, P>,
    selectParent: Comparator<FieldEntry<ID, P>> = compareBy { it.value },
): ID {
    var parent = potential.local
    for (neighbor in potential.neighbors.list) if (selectParent.compare(neighbor, parent) < 0) parent = neighbor
    return parent.id
}

/** The ids of the neighbours whose entries of [potential] satisfy [isParent], ascending. By default, all neighbours downhill. */
@Suppress("UnusedReceiverParameter")
public fun <ID : Any, P : Comparable<P>> Aggregate<ID>.findParents(
    potential: Field<ID, P>,
    isParent: (FieldEntry<ID, P>) -> Boolean = { it.value < potential.local.value },
): Set<ID> = potential.neighbors.list.filter(isParent).mapTo(LinkedHashSet()) { it.id }
