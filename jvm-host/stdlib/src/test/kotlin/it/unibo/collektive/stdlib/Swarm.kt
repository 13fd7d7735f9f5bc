package it.unibo.collektive.stdlib

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.mapNeighborhood
import org.collektive.runtime.AggregateRuntimes
import org.collektive.testkit.Network
import kotlin.random.Random

/** Devices 0, 1, 2 and so on of the real runtime, on a graph that changes at random. */
internal class Swarm(size: Int = 0, private val random: Random = Random(0)) : Network(AggregateRuntimes(), *IntArray(size) { it }) {
    private var nextId = size

    fun add(): Int = nextId++.also { add(it) }

    fun line(vararg lengths: Double) = apply { lengths.forEachIndexed { index, length -> link(index, index + 1, length) } }

    /** Adds and removes devices, and adds, removes and changes about one link in three. */
    fun shake() {
        if (size > 2 && random.nextInt(3) == 0) remove(ids.random(random))
        if (random.nextInt(3) == 0) add()
        for (a in ids) {
            for (b in ids) {
                if (a >= b || random.nextInt(3) != 0) continue
                if (random.nextDouble() < 3.0 / size) link(a, b, random.nextDouble(0.01, 10.0)) else unlink(a, b)
            }
        }
    }

    /** Runs [times] rounds of every device, all at once or one after the other in random order, and returns the last results. */
    fun <R> rounds(times: Int, atOnce: Boolean = true, program: Aggregate<Int>.() -> R): Map<Int, R> {
        val results = sortedMapOf<Int, R>()
        repeat(times) {
            if (atOnce) results += round(program) else for (id in ids.shuffled(random)) results += round(listOf(id), program)
        }
        return results
    }

    /** Returns the lengths of the links as a field. */
    fun Aggregate<Int>.lengths(): Field<Int, Double> = mapNeighborhood { if (it == localId) 0.0 else length(localId, it) }
}

/** Returns the distance and nearest source of each device, by Dijkstra's algorithm from [sources] over devices accepted by [through]. */
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

/** Returns the number of hops to the nearest of [sources], for each device that can reach one. */
internal fun Swarm.hopsFrom(sources: Collection<Int>): Map<Int, Int> =
    shortestPaths(sources) { _, _ -> 1.0 }.mapValues { it.value.first.toInt() }

/** Returns the devices of the connected component of [id]. */
internal fun Swarm.component(id: Int): Set<Int> = shortestPaths(listOf(id)).keys

/** Perturbs random swarms, and calls [check] after each perturbation. The links do not change during the check. */
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
