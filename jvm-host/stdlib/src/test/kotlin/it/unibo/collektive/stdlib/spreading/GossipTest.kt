package it.unibo.collektive.stdlib.spreading

import it.unibo.collektive.stdlib.Swarm
import it.unibo.collektive.stdlib.component
import it.unibo.collektive.stdlib.perturbed
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals

class GossipTest {
    @Test
    fun `all devices have their component's best value within the bound after any perturbation`() = perturbed { swarm, atOnce, random ->
        val values = swarm.ids.associateWith { random.nextInt(100) }
        val seen = swarm.rounds(2 * swarm.size, atOnce) {
            val value = values.getValue(localId)
            val max = alignedOn("max") { gossipMax(value) }
            val min = alignedOn("min") { gossipMin(value) }
            val last = alignedOn("last digit") { gossipMaxBy(value) { it % 10 } % 10 }
            val first = alignedOn("least digit") { gossipMinBy(value) { it % 10 } % 10 }
            listOf(max, min, last, first)
        }
        val expected = swarm.ids.associateWith { id ->
            val all = swarm.component(id).map(values::getValue)
            listOf(all.max(), all.min(), all.maxOf { it % 10 }, all.minOf { it % 10 })
        }
        assertEquals(expected, seen)
    }

    @Test
    fun `a value whose equals ignores a change is updated`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        for (note in listOf("old", "new")) {
            val seen = swarm.rounds(4) { gossipMaxBy(Labelled(-localId, note)) { it.id } }
            assertEquals(List(3) { note }, seen.values.map { it.note })
        }
    }

    @Test
    fun `a condition that holds anywhere is true everywhere, and false again when it ends`() = perturbed(0 until 4) {
            swarm,
            atOnce,
            random,
        ->
        val happening = swarm.ids.filter { random.nextInt(6) == 0 }.toSet()
        val seen = swarm.rounds(2 * swarm.size, atOnce) { isHappeningAnywhere { localId in happening } }
        assertEquals(swarm.ids.associateWith { id -> swarm.component(id).any { it in happening } }, seen)
    }

    @Test
    fun `a value travels one hop farther than maxDiameter`() {
        val swarm = Swarm(5).line(1.0, 1.0, 1.0, 1.0)
        val seen = swarm.rounds(10) { gossipMax(if (localId == 0) 9 else 1, maxDiameter = 2) }
        assertEquals(listOf(9, 9, 9, 9, 1), seen.values.toList())
    }

    @Test
    fun `comparators and selectors choose the best`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        val seen = swarm.rounds(5) {
            val longest = alignedOn("max") { gossipMaxWith("x".repeat(localId), compareBy { it.length }) }
            longest to alignedOn("min") { gossipMinWith("x".repeat(localId), compareBy { it.length }) }
        }
        assertEquals(setOf("xx" to ""), seen.values.toSet())
    }

    @Test
    fun `a reducer that merges takes the last offer that improves the result`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        val seen = swarm.rounds(2) { gossip(setOf(localId)) { a, b -> a + b } }
        assertEquals(mapOf(0 to setOf(0, 1), 1 to setOf(1, 2), 2 to setOf(1, 2)), seen)
    }

    @Test
    fun `a value over a longer path is ignored where a shorter path has its hops in another order`() {
        val swarm = Swarm(4).apply { for ((a, b) in listOf(3 to 2, 2 to 1, 1 to 0, 3 to 0)) link(a, b) }
        fun round(id: Int, best: Int?) = swarm.round(listOf(id)) { gossipMax(if (localId == best) 9 else 0) }.getValue(id)
        for (id in listOf(3, 2, 1)) round(id, best = 3)
        swarm.unlink(3, 2)
        swarm.round(listOf(2)) { gossipMax(5) }
        swarm.link(3, 2)
        assertEquals(5, round(3, best = null))
        assertEquals(5, round(0, best = null), "device 1 offers 9 through 3 and 2, and device 3 offers 5 through 2")
    }

    @Test
    fun `nonStabilizingGossip merges all values and never drops one`() {
        val swarm = Swarm(4).line(1.0, 1.0, 1.0)
        assertEquals(setOf(setOf(0, 1, 2, 3)), swarm.rounds(4) { nonStabilizingGossip(setOf(localId)) { a, b -> a + b } }.values.toSet())
        swarm.remove(3)
        assertEquals(setOf(setOf(0, 1, 2, 3)), swarm.rounds(9) { nonStabilizingGossip(setOf(localId)) { a, b -> a + b } }.values.toSet())
    }

    @Test
    fun `everHappened evaluates the condition only in a device's first round, and stays true`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        assertEquals(setOf(false), swarm.rounds(4) { everHappened { false } }.values.toSet())
        assertEquals(setOf(false), swarm.rounds(4) { everHappened { true } }.values.toSet())
        val late = swarm.add()
        swarm.link(2, late)
        swarm.round { everHappened { localId == late } }
        assertEquals(setOf(true), swarm.rounds(3) { everHappened { false } }.values.toSet())
    }
}
