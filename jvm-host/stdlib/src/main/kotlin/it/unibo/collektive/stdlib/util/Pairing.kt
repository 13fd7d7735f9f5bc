package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.ids

/**
 * Calls [action] with the id, the value and the distance of each neighbour of this field, in ascending order of ids.
 *
 * [metric] may have more neighbours than this field, because it may come from outside the branch that created this field.
 *
 * @throws IllegalStateException when [metric] has no value for a neighbour of this field.
 */
internal inline fun <ID : Any, T, D> Field<ID, T>.forEachNeighborWith(
    metric: Field<ID, D>,
    action: (id: ID, value: T, distance: D) -> Unit,
) {
    // Both fields have the order of this round's links, so one pass over them is sufficient.
    var place = 0
    for (index in 0 until neighborCount) {
        val id = neighborId(index)
        while (place < metric.neighborCount && metric.neighborId(place) != id) place++
        check(place < metric.neighborCount) {
            "the metric covers ${metric.all.ids.list} and has no distance for the aligned neighbour $id; create the metric where it is used"
        }
        action(id, neighborValue(index), metric.neighborValue(place))
    }
}
