package org.collektive.compiler.alignment

/**
 * Remembers which nodes of a graph reach a goal. [search] returns whether a node is a goal or [reaches] holds for one of its successors.
 */
internal class Reachability<T>(private val search: (T) -> Boolean) {
    private val known = HashMap<T, Boolean>()

    // The nodes of the current outermost search.
    private val visited = HashSet<T>()

    fun reaches(node: T): Boolean {
        known[node]?.let { return it }
        val isOutermost = visited.isEmpty()
        if (!visited.add(node)) return false
        val found = search(node)
        if (found) known[node] = true
        if (isOutermost) {
            // If the goal was found, a visited node may still reach it through a node whose search had not ended.
            if (!found) visited.forEach { known[it] = false }
            visited.clear()
        }
        return found
    }
}
