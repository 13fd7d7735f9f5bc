package org.collektive.engine

import kotlin.random.Random

/** What changes in one tick, and who is due. */
internal class Changes(
    val removed: List<Int>,
    val added: List<Int>,
    val unlinked: List<Pair<Int, Int>>,
    val linked: List<Pair<Int, Int>>,
    val due: List<Int>,
) {
    companion object {
        /** A random but valid sequence of [count] ticks, in which nodes and links come and go. */
        fun random(seed: Int, count: Int): List<Changes> {
            val random = Random(seed)
            val nodes = sortedSetOf<Int>()
            val links = sortedSetOf<Pair<Int, Int>>(compareBy({ it.first }, { it.second }))
            return List(count) {
                val removed = nodes.filter { random.nextInt(20) == 0 }.shuffled(random)
                nodes.removeAll(removed.toSet())
                links.removeIf { it.first in removed || it.second in removed }
                val added = List(random.nextInt(6)) { random.nextInt(60) }.distinct().filter { it !in nodes }
                nodes.addAll(added)
                val unlinked = links.filter { random.nextInt(8) == 0 }.shuffled(random)
                links.removeAll(unlinked.toSet())
                val linked = if (nodes.isEmpty()) emptyList() else List(random.nextInt(30)) { nodes.random(random) to nodes.random(random) }
                val valid = linked.filter { it.first != it.second }.distinct()
                links.addAll(valid)
                Changes(removed, added, unlinked, valid, nodes.filter { random.nextInt(5) > 0 })
            }
        }
    }
}

/** One tick with [changes]. */
internal fun TestEngine.step(changes: Changes): TickResult = step {
    changes.removed.forEach(nodesRemoved::add)
    add(*changes.added.toIntArray())
    changes.unlinked.forEach { unlink(it.first, it.second) }
    changes.linked.forEach { link(it.first, it.second) }
    due(*changes.due.toIntArray())
}
