package org.collektive.conformance.golden

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import org.collektive.spi.DeviceRuntimes
import org.collektive.testkit.Network
import kotlin.math.hypot
import kotlin.random.Random

/** The sensor data of a golden program in a round. */
class Senses(
    val id: Int,
    val x: Double,
    val y: Double,
    val tick: Int,
    val flag: Boolean,
    val isSource: Boolean,
    val number: Int,
    val milliseconds: Long,
)

typealias GoldenProgram = Aggregate<Int>.(Senses) -> Any?

/** The initial positions of the nodes. */
enum class Topology(val nodes: Int, val place: (Int) -> Pair<Double, Double>) {
    LINE(12, { it.toDouble() to 0.0 }),
    GRID(25, { (it % 5).toDouble() to (it / 5).toDouble() }),
}

/**
 * The network on which the golden answers were recorded.
 *
 * If it is [churning], nodes move, leave and join, and 70 % of them are due in a tick. Otherwise only the sensor data changes. Do not
 * change the order in which random numbers are drawn, because the recorded answers depend on it.
 */
@CollektiveIgnore("it calls the programs")
class GoldenNetwork(private val topology: Topology, private val churning: Boolean, runtimes: DeviceRuntimes) {
    private val random = Random(SEED * 31 + topology.name.lowercase().hashCode())
    private val network = Network(runtimes)
    private val places = sortedMapOf<Int, Pair<Double, Double>>()
    private var nextId = 0

    /** Returns the answers of all rounds of [program], by tick and node. */
    fun answers(program: GoldenProgram): List<String> {
        repeat(topology.nodes) { add(topology.place(it)) }
        return (1..TICKS).flatMap { tick ->
            if (churning) churn(tick)
            update()
            val due = network.ids.filter { !churning || random.nextInt(10) < 7 }
            network.round(due) { program(sense(localId, tick)) }.values.map { "$it" }
        }
    }

    private fun add(place: Pair<Double, Double>) {
        places[nextId++] = place
    }

    private fun churn(tick: Int) {
        if (tick > CALM && random.nextInt(3) == 0 && places.size > 5) places.remove(places.keys.random(random))
        if (tick > CALM && random.nextInt(4) == 0) {
            add(random.nextDouble(5.0) to random.nextDouble(if (topology == Topology.LINE) 0.1 else 5.0))
        }
        for (id in places.keys.toList()) {
            if (random.nextInt(10) != 0) continue
            val (x, y) = places.getValue(id)
            places[id] = x + random.nextDouble(-.6, .6) to y + random.nextDouble(-.6, .6)
        }
    }

    /** Updates nodes and links to [places]. */
    private fun update() {
        (network.ids - places.keys).forEach(network::remove)
        (places.keys - network.ids).forEach { network.add(it) }
        for ((a, from) in places) {
            for ((b, to) in places.tailMap(a + 1)) {
                if (hypot(from.first - to.first, from.second - to.second) <= RANGE) network.link(a, b) else network.unlink(a, b)
            }
        }
    }

    private fun sense(id: Int, tick: Int): Senses {
        val (x, y) = places.getValue(id)
        val numbers = Random(SEED * 7919 + tick / 3 * 101 + id)
        val isSource = if (tick < 14) id == 0 else id == 2
        return Senses(id, x, y, tick, numbers.nextBoolean(), isSource, numbers.nextInt(10), 1_000_000L + tick * 500L + id)
    }

    private companion object {
        const val SEED = 1
        const val TICKS = 25
        const val CALM = 8
        const val RANGE = 1.5
    }
}
