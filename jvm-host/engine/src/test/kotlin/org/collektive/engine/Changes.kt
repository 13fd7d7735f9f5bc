package org.collektive.engine

import kotlin.random.Random

/** A directed link. */
internal data class Line(val from: Int, val to: Int)

/** The values of a link. */
internal class Values(val length: Float, val attenuation: Float)

/** The changes and the due nodes of one tick. */
internal class Changes(
    val removed: List<Int>,
    val added: List<Int>,
    val unlinked: List<Line>,
    val linked: List<Pair<Line, Values>>,
    val due: List<Int>,
    val globals: Int?,
) {
    companion object {
        /** Returns [count] random valid ticks that add and remove nodes and links. Some are removed and added again in the same tick. */
        fun random(seed: Int, count: Int): List<Changes> {
            val random = Random(seed)
            val nodes = sortedSetOf<Int>()
            val links = sortedSetOf<Line>(compareBy({ it.from }, { it.to }))
            return List(count) {
                val removed = nodes.filter { random.nextInt(20) == 0 }.shuffled(random)
                nodes.removeAll(removed.toSet())
                links.removeIf { it.from in removed || it.to in removed }
                val added = (List(random.nextInt(6)) { random.nextInt(60) } + removed.take(1)).distinct().filter { it !in nodes }
                nodes.addAll(added)
                val unlinked = links.filter { random.nextInt(8) == 0 }.shuffled(random)
                links.removeAll(unlinked.toSet())
                val chosen = if (nodes.isEmpty()) {
                    emptyList()
                } else {
                    List(random.nextInt(30)) {
                        Line(nodes.random(random), nodes.random(random))
                    }
                }
                val linked = (chosen + unlinked.filter { random.nextInt(3) == 0 }).filter { it.from != it.to }.distinct()
                links.addAll(linked)
                val values = linked.map { it to Values(random.nextInt(20).toFloat(), random.nextInt(3).toFloat()) }
                Changes(removed, added, unlinked, values, nodes.filter { random.nextInt(5) > 0 }, random.nextInt(100).takeIf { it < 20 })
            }
        }
    }
}

/** Runs a tick with [changes], in their own order or in a random one. */
internal fun TestEngine.step(changes: Changes, order: Random? = null): TickResult = step {
    fun <T> List<T>.arriving() = if (order == null) this else shuffled(order)
    changes.removed.arriving().forEach(nodesRemoved::add)
    add(*changes.added.arriving().toIntArray())
    changes.unlinked.arriving().forEach { unlink(it.from, it.to) }
    changes.linked.arriving().forEach { (line, values) -> link(line.from, line.to, values.length, values.attenuation) }
    due(*changes.due.toIntArray())
    globals = changes.globals
}
