package it.unibo.collektive.stdlib.consensus

import it.unibo.collektive.stdlib.Swarm
import it.unibo.collektive.stdlib.component
import it.unibo.collektive.stdlib.perturbed
import it.unibo.collektive.stdlib.shortestPaths
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals

class ElectionTest {
    /**
     * Returns the expected leader of each device. The strongest device leads all within the bound, then the strongest of the remaining
     * devices does, and so on.
     */
    private fun Swarm.leaders(strengths: Map<Int, Int>, bound: Double, length: (Int, Int) -> Double): Map<Int, Int> {
        val leaders = sortedMapOf<Int, Int>()
        for (candidate in ids.sortedByDescending(strengths::getValue)) {
            if (candidate in leaders) continue
            val reached = shortestPaths(listOf(candidate), { it !in leaders }, length)
            for ((id, path) in reached) if (path.first <= bound) leaders[id] = candidate
        }
        return leaders
    }

    @Test
    fun `leaders are those of the greedy partition within the bound after any perturbation`() = perturbed { swarm, atOnce, random ->
        val strengths = swarm.ids.shuffled(random).mapIndexed { index, id -> id to index }.toMap()
        val bound = random.nextInt(1, 5)
        val expected = swarm.leaders(strengths, bound.toDouble()) { _, _ -> 1.0 }
        val levels = expected.values.toSet().size
        val seen = swarm.rounds(2 * (bound + 1) * (levels + 1), atOnce) { boundedElection(strengths.getValue(localId), bound) }
        assertEquals(expected, seen)
    }

    @Test
    fun `distances may be of any metric`() = perturbed(0 until 4) { swarm, atOnce, random ->
        val bound = random.nextDouble(2.0, 20.0)
        val expected = swarm.leaders(swarm.ids.associateWith { it }, bound, swarm::length)
        val seen = swarm.rounds(2 * 2000 * 1, atOnce) { boundedElection(bound, with(swarm) { lengths() }) }
        assertEquals(expected, seen)
    }

    @Test
    fun `the strongest device of a component leads it, also after it left`() {
        val swarm = Swarm(4).line(1.0, 1.0, 1.0)
        val seen = swarm.rounds(4) { alignedOn("strength") { globalElection(-localId) } to alignedOn("id") { globalElection() } }
        assertEquals(setOf(0 to 3), seen.values.toSet())
        swarm.remove(3)
        assertEquals(setOf(3), swarm.rounds(20) { alignedOn("id") { globalElection() } }.values.toSet())
    }

    @Test
    fun `equally strong leaders divide a component by distance`() {
        val swarm = Swarm(6).line(1.0, 1.0, 1.0, 1.0, 1.0)
        val seen = swarm.rounds(12) { globalElection(if (localId == 0 || localId == 5) 1 else 0) }
        assertEquals(listOf(0, 0, 0, 5, 5, 5), seen.values.toList())
    }

    @Test
    fun `selectBest replaces the order of candidacies`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        val seen = swarm.rounds(6) { boundedElection(localId, 9) { a, b -> minOf(a, b) } }
        assertEquals(setOf(0), seen.values.toSet())
    }

    @Test
    fun `the stronger candidacy is greater, then the nearer`() {
        val ascending = listOf(Candidacy(1, 5, 0), Candidacy(2, 9, 1), Candidacy(3, 4, 1))
        assertEquals(ascending, ascending.reversed().sorted())
        assertEquals(0, Candidacy(1, 2, 3).compareTo(Candidacy(9, 2, 3)))
    }
}
