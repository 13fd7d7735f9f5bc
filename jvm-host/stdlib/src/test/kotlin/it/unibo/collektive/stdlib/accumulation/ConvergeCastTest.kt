package it.unibo.collektive.stdlib.accumulation

import it.unibo.collektive.aggregate.Field
import it.unibo.collektive.aggregate.api.mapNeighborhood
import it.unibo.collektive.stdlib.Swarm
import it.unibo.collektive.stdlib.hopsFrom
import it.unibo.collektive.stdlib.perturbed
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals

class ConvergeCastTest {
    /** Returns the expected sum of each device's subtree. Its parent has the lowest id of the neighbours one hop nearer to a sink. */
    private fun Swarm.treeSums(sinks: Collection<Int>, values: Map<Int, Int>): Map<Int, Int> {
        val hops = hopsFrom(sinks)
        fun parent(id: Int) = hops[id]?.let { mine -> neighbors(id).filter { (hops[it] ?: Int.MAX_VALUE) < mine }.minOrNull() }
        fun sum(id: Int): Int = values.getValue(id) + neighbors(id).filter { parent(it) == id }.sumOf(::sum)
        return ids.associateWith(::sum)
    }

    @Test
    fun `a sink has the sum of its tree within the bound after any perturbation`() = perturbed { swarm, atOnce, random ->
        val sinks = setOf(swarm.ids.random(random))
        val values = swarm.ids.associateWith { random.nextInt(-50, 50) }
        val seen = swarm.rounds(3 * swarm.size + 1, atOnce) { convergeSum(values.getValue(localId), localId in sinks) }
        val reached = swarm.hopsFrom(sinks).keys
        assertEquals(swarm.treeSums(sinks, values).filterKeys(reached::contains), seen.filterKeys(reached::contains))
    }

    @Test
    fun `counts, means and sums agree for every kind of potential`() = perturbed(0 until 4) { swarm, atOnce, _ ->
        val sink = swarm.ids.first()
        val hops = swarm.hopsFrom(listOf(sink))
        fun potential(id: Int) = hops[id] ?: Int.MAX_VALUE
        val seen = swarm.rounds(2 * swarm.size + 1, atOnce) {
            val field: Field<Int, Int> = mapNeighborhood(::potential)
            val value = localId.toDouble()
            listOf(
                alignedOn("count field") { countDevices(field) } to alignedOn("count") { countDevices(potential(localId)) },
                alignedOn("sum field") { convergeSum(value, field) } to alignedOn("sum") { convergeSum(value, potential(localId)) },
                alignedOn("mean field") { convergeMean(value, field) } to alignedOn("mean") { convergeMean(value, potential(localId)) },
                alignedOn("int field") { convergeSum(localId, field) } to alignedOn("int") { convergeSum(localId, potential(localId)) },
            )
        }.getValue(sink)
        val all = hops.keys
        val expected = listOf<Number>(all.size, all.sum().toDouble(), all.average(), all.sum())
        assertEquals(expected.map { it to it }, seen)
    }

    @Test
    fun `sinks may be given instead of a potential`() {
        val swarm = Swarm(4).line(1.0, 1.0, 1.0)
        val seen = swarm.rounds(12) {
            listOf(
                alignedOn(1) { countDevices(localId == 0) },
                alignedOn(2) { convergeSum(localId.toDouble(), localId == 0) },
                alignedOn(3) { convergeMean(localId.toDouble(), localId == 0) },
                alignedOn(4) { convergeCast(setOf(localId), localId == 0) { a, b -> a + b } },
            )
        }
        assertEquals(listOf<Any>(4, 6.0, 1.5, setOf(0, 1, 2, 3)), seen.getValue(0))
    }

    @Test
    fun `of equal potentials a neighbour's wins`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        assertEquals(mapOf(0 to 1, 1 to 0, 2 to 1), swarm.rounds(2) { findParent(7.0) })
    }

    @Test
    fun `parents are downhill, the lowest id on ties`() {
        val swarm = Swarm(4)
        for (id in 0..2) swarm.link(id, 3)
        val potential = mapOf(0 to 5, 1 to 2, 2 to 2, 3 to 4)
        val seen = swarm.rounds(2) {
            val field = mapNeighborhood(potential::getValue)
            listOf(
                findParent(field),
                findParent(field, compareByDescending { it.value }),
                findParents(field),
                findParents(field) {
                    it.value ==
                        5
                },
            )
        }
        assertEquals(listOf<Any>(1, 0, setOf(1, 2), setOf(0)), seen.getValue(3))
        assertEquals(1, seen.getValue(1).first(), "a device at a minimum must be its own parent")
    }
}
