@file:CollektiveIgnore("uses no primitives")

package it.unibo.collektive.stdlib.accumulation

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.FieldEntry
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore

/**
 * The id of the entry of [potential] that is least by [selectParent]: the next device downhill, or this one at the bottom. On ties
 * this device wins, then the lower id, so that devices of one potential never choose each other.
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

/** The ids of all neighbours whose entries of [potential] satisfy [isParent]: by default, all devices downhill; ascending. */
@Suppress("UnusedReceiverParameter")
public fun <ID : Any, P : Comparable<P>> Aggregate<ID>.findParents(
    potential: Field<ID, P>,
    isParent: (FieldEntry<ID, P>) -> Boolean = { it.value < potential.local.value },
): Set<ID> = potential.neighbors.list.filter(isParent).mapTo(LinkedHashSet()) { it.id }
