package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.stdlib.Swarm
import it.unibo.collektive.stdlib.shortestPaths
import org.junit.jupiter.api.Test
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class BellmanFordGradientCastTest {
    private fun Aggregate<Int>.distance(swarm: Swarm, source: Boolean) = bellmanFordGradientCast(
        source,
        if (source) 0.0 else Double.POSITIVE_INFINITY,
        accumulateData = { fromSource, toNeighbor, _ -> fromSource + toNeighbor },
        metric = with(swarm) { lengths() },
    )

    @Test
    fun `distances are shortest paths after as many rounds as there are devices`() {
        for (seed in 0 until 30) {
            val random = Random(seed)
            val swarm = Swarm(random.nextInt(2, 18), random)
            swarm.shake()
            val sources = swarm.ids.filter { random.nextInt(4) == 0 }
            val seen = swarm.rounds(swarm.size + 1, random.nextBoolean()) { distance(swarm, localId in sources) }
            val paths = swarm.shortestPaths(sources)
            assertEquals(swarm.ids.associateWith { paths[it]?.first ?: Double.POSITIVE_INFINITY }, seen)
        }
    }

    @Test
    fun `it counts to infinity as documented`() {
        val swarm = Swarm(4).line(1.0, 1.0, 0.1)
        swarm.rounds(6) { distance(swarm, localId == 0) }
        swarm.unlink(1, 2)
        val before = swarm.round { distance(swarm, localId == 0) }.getValue(2)
        val after = swarm.rounds(10) { distance(swarm, localId == 0) }.getValue(2)
        assertEquals(before + 1.0, after, 1e-9)
        assertTrue(swarm.rounds(100) { distance(swarm, localId == 0) }.getValue(2) < 20.0, "the distance must still rise")
    }

    @Test
    fun `distances that are too small rise by the metric each round`() {
        val swarm = Swarm(4).line(1.0, 1.0, 0.5)
        swarm.link(3, 0, 20.0)
        swarm.rounds(6) { distance(swarm, localId == 0) }
        swarm.unlink(1, 2)
        val seen = swarm.rounds(50) { distance(swarm, localId == 0) }
        assertEquals(mapOf(0 to 0.0, 1 to 1.0, 2 to 20.5, 3 to 20.0), seen)
    }

    @Test
    fun `the metric and the distances are coerced to bottom and top`() {
        val swarm = Swarm(4).line(-5.0, 50.0, 1.0)
        val seen = swarm.rounds(5) {
            bellmanFordGradientCast(
                localId == 0,
                0.0,
                1.0,
                10.0,
                accumulateData = { fromSource, toNeighbor, _ -> fromSource + toNeighbor },
                accumulateDistance = { a, b -> a + b },
                metric = with(swarm) { lengths() },
            )
        }
        assertEquals(mapOf(0 to 0.0, 1 to 1.0 + 1.0, 2 to 2.0 + 10.0, 3 to 10.0 + 1.0), seen)
    }

    @Test
    fun `a sum that is less than one of its parts is an error`() {
        val swarm = Swarm(2).line(1.0)
        val error = assertFailsWith<IllegalStateException> {
            swarm.rounds(2) {
                bellmanFordGradientCast(localId == 0, 0, accumulateDistance = { a, b -> a - b }, metric = with(swarm) { lengths() })
            }
        }
        assertTrue("triangle inequality" in error.message.orEmpty(), error.message)
    }

    @Test
    fun `without a source the result is a neighbour's, or the local value without neighbours`() {
        val swarm = Swarm(4).line(1.0, 1.0)
        val first = swarm.round { bellmanFordGradientCast(false, localId, metric = with(swarm) { lengths() }) }
        assertEquals(mapOf(0 to 0, 1 to 1, 2 to 2, 3 to 3), first)
        val second = swarm.round { bellmanFordGradientCast(false, localId, metric = with(swarm) { lengths() }) }
        assertEquals(mapOf(0 to 1, 1 to 0, 2 to 1, 3 to 3), second)
    }
}
