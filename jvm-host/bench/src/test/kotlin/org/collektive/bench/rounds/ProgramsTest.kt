package org.collektive.bench.rounds

import org.collektive.engine.TickResult
import java.util.PriorityQueue
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Checks that the benchmarked programs compute correct results. */
class ProgramsTest {
    @Test
    fun `a - engine and loops compute the same headings`() = settled("a") { network, result ->
        val byHand = HandwrittenRounds("a", network)
        repeat(2) { byHand.tick() }
        for (id in 0 until network.size) {
            val heading = result.answer(id) as Heading
            assertEquals(byHand.headingX[id], heading.x, 1e-12, "node $id")
            assertEquals(byHand.headingY[id], heading.y, 1e-12, "node $id")
        }
    }

    @Test
    fun `b - the distances are shortest paths`() = settled("b") { network, result ->
        val expected = shortestPaths(network)
        for (id in 0 until network.size) assertEquals(expected[id], result.answer(id) as Double, 1e-9, "node $id")
    }

    @Test
    fun `b2 - the distances are shortest paths, in the engine and in the loops`() = settled("b2") { network, result ->
        val expected = shortestPaths(network)
        val byHand = HandwrittenRounds("b2", network)
        repeat(TICKS) { byHand.tick() }
        for (id in 0 until network.size) {
            assertEquals(expected[id], result.answer(id) as Double, 1e-9, "node $id")
            assertEquals(byHand.distances[id], result.answer(id) as Double, 1e-9, "node $id")
        }
    }

    @Test
    fun `c - leaders count every device once, and each device receives its leader's count`() = settled("c") { network, result ->
        val regions = List(network.size) { result.answer(it) as Region }
        val counts = regions.filter { it.isLeader }.map { it.devices }
        assertEquals(network.size, counts.sum())
        assertTrue(regions.all { it.devices in counts })
    }

    private fun settled(program: String, check: (Topology, TickResult) -> Unit) {
        for (topology in listOf("grid8", "rgg10")) {
            val network = Topology.named(topology, 400)
            EngineRounds(program, network).use { rounds ->
                repeat(TICKS - 2) { rounds.tick() }
                check(network, rounds.tick())
            }
        }
    }

    private fun shortestPaths(network: Topology): DoubleArray {
        val distances = DoubleArray(network.size) { Double.POSITIVE_INFINITY }
        val source = sensorData(network).indexOfFirst { it.isSource }
        val open = PriorityQueue<Pair<Double, Int>>(compareBy { it.first })
        open += 0.0 to source
        while (true) {
            val (distance, id) = open.poll() ?: return distances
            if (distance >= distances[id]) continue
            distances[id] = distance
            for (neighbor in network.neighbors[id]) open += distance + network.distance(id, neighbor) to neighbor
        }
    }

    private companion object {
        const val TICKS = 120
    }
}
