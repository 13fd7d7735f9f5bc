@file:OptIn(DelicateCollektiveApi::class)

package it.unibo.collektive.stdlib

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.DelicateCollektiveApi
import it.unibo.collektive.aggregate.api.mapNeighborhood
import org.collektive.runtime.AggregateRuntimes
import org.collektive.runtime.round
import org.collektive.spi.DeviceRuntime
import org.collektive.spi.Export
import org.collektive.spi.Inbox
import kotlin.random.Random

/** Devices of the real runtime on a graph with link lengths. Tests change the graph between rounds. */
internal class Swarm(size: Int = 0, private val random: Random = Random(0)) {
    private val runtimes = AggregateRuntimes()
    private val members = sortedMapOf<Int, Member>()
    private var nextId = 0
    private var now = 0

    val ids: List<Int> get() = members.keys.toList()
    val size: Int get() = members.size

    init {
        repeat(size) { add() }
    }

    fun add(): Int = nextId++.also { members[it] = Member(it, runtimes.device(it)) }

    fun remove(id: Int) {
        members.remove(id)
        for (member in members.values) member.links.remove(id)
    }

    fun link(a: Int, b: Int, length: Double = 1.0) {
        members.getValue(a).links.getOrPut(b) { Link(now) }.length = length
        members.getValue(b).links.getOrPut(a) { Link(now) }.length = length
    }

    fun cut(a: Int, b: Int) {
        members.getValue(a).links.remove(b)
        members.getValue(b).links.remove(a)
    }

    fun line(vararg lengths: Double) = apply { lengths.forEachIndexed { index, length -> link(ids[index], ids[index + 1], length) } }

    fun neighbors(id: Int): Set<Int> = members.getValue(id).links.keys

    fun length(a: Int, b: Int): Double = members.getValue(a).links.getValue(b).length

    /** Adds and removes devices, and adds, removes and changes about one link in three. */
    fun shake() {
        if (size > 2 && random.nextInt(3) == 0) remove(ids.random(random))
        if (random.nextInt(3) == 0) add()
        for (a in ids) {
            for (b in ids) {
                if (a >= b || random.nextInt(3) != 0) continue
                if (random.nextDouble() < 3.0 / size) link(a, b, random.nextDouble(0.01, 10.0)) else cut(a, b)
            }
        }
    }

    /** Runs a round of every device: all at once, or one after another in random order. */
    fun <R> round(atOnce: Boolean = true, program: Aggregate<Int>.() -> R): Map<Int, R> {
        val results = sortedMapOf<Int, R>()
        val waves = if (atOnce) listOf(ids) else ids.shuffled(random).map { listOf(it) }
        for (wave in waves) {
            now++
            for (id in wave) {
                val member = members.getValue(id)
                results[id] = member.runtime.round(member, program)
            }
            for (id in wave) {
                members.getValue(id).run {
                    export = runtime.commit()
                    sentAt = now
                }
            }
        }
        return results
    }

    /** Calls [round] [times] times and returns the last results. */
    fun <R> rounds(times: Int, atOnce: Boolean = true, program: Aggregate<Int>.() -> R): Map<Int, R> {
        repeat(times - 1) { round(atOnce, program) }
        return round(atOnce, program)
    }

    /** The lengths of the links, as a field of a program. */
    fun Aggregate<Int>.lengths(): Field<Int, Double> = mapNeighborhood { if (it == localId) 0.0 else length(localId, it) }

    private class Link(val since: Int) {
        var length = 1.0
    }

    private inner class Member(val id: Int, val runtime: DeviceRuntime) : Inbox {
        val links = sortedMapOf<Int, Link>()
        var export: Export? = null
        var sentAt = 0

        override val size get() = links.size
        override val ids: Array<Any> get() = links.keys.toTypedArray()
        override fun export(index: Int) = members.getValue(links.keys.elementAt(index)).export

        override fun wasKnown(index: Int): Boolean {
            val sender = links.keys.elementAt(index)
            return links.getValue(sender).since < members.getValue(sender).sentAt
        }
    }
}

/** Distance and nearest source of each device, by Dijkstra's algorithm from [sources] over devices for which [through] holds. */
internal fun Swarm.shortestPaths(
    sources: Collection<Int>,
    through: (Int) -> Boolean = { true },
    length: (Int, Int) -> Double = ::length,
): Map<Int, Pair<Double, Int>> {
    val found = sources.associateWith { 0.0 to it }.toMutableMap()
    val open = sources.toMutableSet()
    while (open.isNotEmpty()) {
        val next = open.minBy { found.getValue(it).first }
        open -= next
        val (distance, source) = found.getValue(next)
        for (neighbor in neighbors(next)) {
            if (!through(neighbor)) continue
            val reached = distance + length(next, neighbor)
            if (reached < (found[neighbor]?.first ?: Double.POSITIVE_INFINITY)) {
                found[neighbor] = reached to source
                open += neighbor
            }
        }
    }
    return found
}

/** Hops to the nearest of [sources], for devices that reach one. */
internal fun Swarm.hopsFrom(sources: Collection<Int>): Map<Int, Int> =
    shortestPaths(sources) { _, _ -> 1.0 }.mapValues { it.value.first.toInt() }

/** The devices of the connected component of [id]. */
internal fun Swarm.component(id: Int): Set<Int> = shortestPaths(listOf(id)).keys

/** Perturbs random swarms, and calls [check] after each perturbation, with links that then stay unchanged. */
internal fun perturbed(seeds: IntRange = 0 until 12, check: (swarm: Swarm, atOnce: Boolean, random: Random) -> Unit) {
    for (seed in seeds) {
        val random = Random(seed)
        val swarm = Swarm(random.nextInt(2, 18), random)
        repeat(6) {
            repeat(random.nextInt(1, 4)) { swarm.shake() }
            check(swarm, random.nextBoolean(), random)
        }
    }
}
