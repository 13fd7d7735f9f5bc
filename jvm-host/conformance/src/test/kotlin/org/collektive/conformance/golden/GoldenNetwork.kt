package org.collektive.conformance.golden

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import org.collektive.api.Parameters
import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.LinkList
import org.collektive.engine.NewNode
import org.collektive.engine.NodeProgram
import org.collektive.engine.RoundData
import org.collektive.engine.RoundDevice
import org.collektive.engine.Schedule
import org.collektive.engine.Tick
import org.collektive.spi.DeviceRuntimes
import kotlin.math.hypot
import kotlin.random.Random

/** What a golden program senses in a round. */
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

/** Where the network's nodes are at the start. */
enum class Topology(val nodes: Int, val place: (Int) -> Pair<Double, Double>) {
    LINE(12, { it.toDouble() to 0.0 }),
    GRID(25, { (it % 5).toDouble() to (it / 5).toDouble() }),
}

/**
 * The network that the golden answers were measured on. When it is [churning], nodes move, leave and join, and 70 % of them are due in a
 * tick; otherwise nothing changes but what nodes sense. The order of random numbers is part of it.
 */
@CollektiveIgnore("it drives the programs")
class GoldenNetwork(private val topology: Topology, private val churning: Boolean) {
    private val random = Random(SEED * 31 + topology.name.lowercase().hashCode())
    private val places = sortedMapOf<Int, Pair<Double, Double>>()
    private val known = HashSet<Int>()
    private var linked = emptySet<Pair<Int, Int>>()
    private var nextId = 0

    /** The answers of all rounds of [program], by tick and node. A failed round's answer is its error. */
    fun answers(program: GoldenProgram, runtimes: DeviceRuntimes): List<String> =
        Engine(EngineSettings(1, 1, Schedule.LOCKSTEP), runtimes).use { engine ->
            repeat(topology.nodes) { add(topology.place(it)) }
            (1..TICKS).flatMap { number ->
                if (churning) churn(number)
                val tick = tick(number, nodeProgram(program))
                val senses = (0 until tick.due.size).map { sense(tick.due[it], number) }
                val result = engine.step(tick, Data(senses), System.nanoTime() + 60_000_000_000)
                (0 until result.size).map { index -> result.failure(index)?.let { "FAIL $it" } ?: result.answer(index).toString() }
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

    private fun tick(number: Int, program: NodeProgram) = Tick().apply {
        this.number = number.toLong()
        time = number * .5
        deltaTime = .5
        for (gone in known - places.keys) {
            known -= gone
            linked = linked.filterTo(HashSet()) { (from, to) -> from != gone && to != gone }
            nodesRemoved.add(gone)
        }
        for (id in places.keys - known) {
            known += id
            nodesAdded += NewNode(id, program, NO_PARAMETERS)
        }
        val near = near()
        for ((from, to) in linked - near) {
            linksRemoved.add(from)
            linksRemoved.add(to)
        }
        links = LinkList().apply { for ((from, to) in near - linked) add(from, to, 1f, 0f) }
        linked = near
        places.keys.filter { !churning || random.nextInt(10) < 7 }.forEach(due::add)
    }

    private fun near() = places.flatMapTo(HashSet()) { (from, a) ->
        places.filter { (to, b) -> from != to && hypot(a.first - b.first, a.second - b.second) <= RANGE }.keys.map { from to it }
    }

    private fun sense(id: Int, tick: Int): Senses {
        val (x, y) = places.getValue(id)
        val numbers = Random(SEED * 7919 + tick / 3 * 101 + id)
        val isSource = if (tick < 14) id == 0 else id == 2
        return Senses(id, x, y, tick, numbers.nextBoolean(), isSource, numbers.nextInt(10), 1_000_000L + tick * 500L + id)
    }

    private fun nodeProgram(program: GoldenProgram) = object : NodeProgram {
        override val name = "golden"

        @Suppress("UNCHECKED_CAST")
        override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any =
            program(aggregate as Aggregate<Int>, sensors as Senses) ?: "null"

        override fun describe(failure: Throwable, place: String?) = "$failure $place"
    }

    private class Data(private val senses: List<Senses>) : RoundData {
        override fun sensors(worker: Int, index: Int) = senses[index]

        override fun pack(worker: Int, index: Int, answer: Any): String? = null
    }

    private companion object {
        const val SEED = 1
        const val TICKS = 25
        const val CALM = 8
        const val RANGE = 1.5
        val NO_PARAMETERS = Parameters(emptyMap<String, String>())
    }
}
