package org.collektive.conformance.alignment

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.api.exchanging
import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.ids
import it.unibo.collektive.aggregate.values
import it.unibo.collektive.stdlib.collapse.sum
import org.collektive.api.Parameters
import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.LinkList
import org.collektive.engine.NetworkModel
import org.collektive.engine.NewNode
import org.collektive.engine.NodeProgram
import org.collektive.engine.RoundData
import org.collektive.engine.RoundDevice
import org.collektive.engine.Schedule
import org.collektive.engine.Tick
import org.collektive.mailbox.MailboxRuntimes
import org.collektive.runtime.AggregateRuntimes
import org.collektive.spi.DeviceRuntimes
import org.collektive.spi.Export
import org.collektive.spi.MessageSize
import org.collektive.testkit.Network
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Sends the sum of all values to the neighbour with the lowest id, and 0 to the other neighbours. */
private fun Aggregate<Int>.passToFirst(number: Int): Int = exchanging(number) { seen ->
    val first = seen.neighbors.ids.list.minOrNull()
    mapNeighborhood { id -> if (id == first) seen.all.values.sum() % MODULUS else 0 }.yielding { seen.all.values.sum() }
}

/** Sends each neighbour the sum of the neighbour's id and last value. */
private fun Aggregate<Int>.reply(number: Int): Int = exchanging(number) { seen ->
    seen.map { (id, value) -> (id + value) % MODULUS }.yielding { seen.all.values.sum() }
}

/** Sends a different value to each neighbour, in two branches. */
private fun Aggregate<Int>.branch(number: Int): Int = if (number % 2 == 0) {
    exchanging(number) { seen ->
        mapNeighborhood { id -> if (id > localId) number else seen.local.value }.yielding { seen.all.values.sum() }
    }
} else {
    exchanging(-number) { seen -> seen.map { (id, value) -> if (id % 2 == 0) value else number }.yielding { seen.all.values.sum() } }
}

/** Calls a primitive for each entry of a field, and reads a field from outside in that call. */
private fun Aggregate<Int>.nested(number: Int): Int {
    val numbers = neighboring(number)
    return mapNeighborhood { id ->
        neighboring(number + id).all.values.sum() + if (id % 2 ==
            0
        ) {
            numbers.all.values.sum()
        } else {
            0
        }
    }.all.values.sum()
}

/** Sums the numbers of all neighbours, once for each entry except this device's own. */
private fun Aggregate<Int>.outerSums(): List<Int> {
    val numbers = neighboring(listOf(1, 10, 100)[localId])
    return mapNeighborhood { id -> if (id != localId) numbers.all.values.sum() else 0 }.neighbors.values.list
}

private const val MODULUS = 1009

/** Tests that each receiver gets its own value while links change. */
@CollektiveIgnore("it calls the programs")
class PerNeighbourTest {
    private val programs = mapOf<String, Aggregate<Int>.(Int) -> Int>(
        "pass to first" to Aggregate<Int>::passToFirst,
        "reply" to Aggregate<Int>::reply,
        "branch" to Aggregate<Int>::branch,
        "nested" to Aggregate<Int>::nested,
    )
    private val networks = listOf(
        NetworkModel(),
        NetworkModel(delay = 0.7, jitter = 1.5),
        NetworkModel(loss = 0.3, delay = 0.2, retention = 1.2, burstShare = 0.3, burstLength = 2.0),
    )

    @TestFactory
    fun `both runtimes give the same answers and message sizes while nodes and links come and go`(): List<DynamicTest> =
        programs.flatMap { (name, program) ->
            Schedule.entries.flatMap { schedule ->
                networks.mapIndexed { index, network ->
                    DynamicTest.dynamicTest("$name, $schedule, network $index") {
                        val seed = name.hashCode() + index
                        val own = answers(AggregateRuntimes(), schedule, network, seed, program)
                        assertEquals(own, answers(MailboxRuntimes(), schedule, network, seed, program))
                        assertTrue(own.toSet().size > 100, "the answers must vary, or the comparison proves little")
                    }
                }
            }
        }

    @Test
    fun `a field from outside is read in a branch inside mapNeighborhood by all that reached the branch for any entry`() {
        for (runtimes in listOf(AggregateRuntimes(), MailboxRuntimes())) {
            val network = Network(runtimes, 0, 1, 2).apply { line(1, 0, 2) }
            val seen = (1..3).map { network.round { outerSums() } }.last()
            assertEquals(mapOf(0 to listOf(111, 111), 1 to listOf(11), 2 to listOf(101)), seen)
        }
    }

    private fun answers(
        runtimes: DeviceRuntimes,
        schedule: Schedule,
        network: NetworkModel,
        seed: Int,
        program: Aggregate<Int>.(Int) -> Int,
    ): List<String> = Engine(EngineSettings(1, 1, schedule, network), runtimes).use { engine ->
        val random = Random(seed)
        val nodes = sortedSetOf<Int>()
        val links = LinkedHashSet<Pair<Int, Int>>()
        (1L..80L).flatMap { number ->
            val tick = Tick()
            tick.number = number
            tick.time = 0.5 * number
            tick.deltaTime = 0.5
            for (id in nodes.filter { random.nextInt(12) == 0 }) {
                nodes -= id
                links.removeIf { id in it.toList() }
                tick.nodesRemoved.add(id)
            }
            for (id in 0 until 12) {
                if (id in nodes || random.nextInt(3) > 0) continue
                nodes += id
                tick.nodesAdded += NewNode(id, Program(program), Parameters(emptyMap()))
            }
            tick.links = LinkList().apply {
                for (from in nodes) {
                    for (to in nodes) {
                        val link = from to to
                        if (from == to || random.nextInt(6) > 0) continue
                        if (link in links) {
                            links -= link
                            tick.linksRemoved.add(from)
                            tick.linksRemoved.add(to)
                        } else {
                            links += link
                            add(from, to, 1f, 0f)
                        }
                    }
                }
            }
            val due = nodes.filter { random.nextInt(10) < 7 }
            due.forEach(tick.due::add)
            val result = engine.step(tick, Numbers(due.map { random.nextInt(50) }), System.nanoTime() + LIMIT)
            (0 until result.size).map {
                "$number ${result.id(it)}: ${result.failure(it) ?: result.answer(it)}, ${sizeOf(result.export(it))}"
            }
        }
    }

    private fun sizeOf(export: Export?): String = MessageSize().let { size ->
        export?.measure(size)
        "${size.values} values in ${size.bytes} bytes"
    }

    private class Numbers(private val numbers: List<Int>) : RoundData {
        override fun sensors(worker: Int, index: Int): Any = numbers[index]

        override fun pack(worker: Int, index: Int, answer: Any): String? = null
    }

    private class Program(private val program: Aggregate<Int>.(Int) -> Int) : NodeProgram {
        override val name = "test"

        @Suppress("UNCHECKED_CAST")
        override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any = (aggregate as Aggregate<Int>).program(sensors as Int)

        override fun describe(failure: Throwable, place: String?): String = failure.toString()
    }

    private companion object {
        const val LIMIT = 60_000_000_000
    }
}
