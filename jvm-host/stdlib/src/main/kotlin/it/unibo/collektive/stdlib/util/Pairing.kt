package it.unibo.collektive.stdlib.util

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.ids

/**
 * Runs [action] with the id, the value and the distance of each neighbour, ascending.
 *
 * [metric] may know more neighbours: it may come from outside the branch that this field was made in.
 *
 * @throws IllegalStateException when [metric] lacks one.
 */
internal inline fun <ID : Any, T, D> Field<ID, T>.forEachNeighborWith(
    metric: Field<ID, D>,
    action: (id: ID, value: T, distance: D) -> Unit,
) {
    val neighbors = neighbors.list
    val distances = metric.neighbors.list
    // Both are in the order of this round's links.
    var place = 0
    for (neighbor in neighbors) {
        while (place < distances.size && distances[place].id != neighbor.id) place++
        check(place < distances.size) {
            "the metric, over ${metric.all.ids.list}, has no distance to the aligned neighbour ${neighbor.id}; make it where it is used"
        }
        action(neighbor.id, neighbor.value, distances[place].value)
    }
}
