package org.collektive.conformance.links

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.stdlib.spreading.distanceTo
import org.collektive.api.Device
import org.collektive.links.attenuations
import org.collektive.links.distances
import org.collektive.testing.TestNetwork
import kotlin.test.Test
import kotlin.test.assertEquals

fun Aggregate<Int>.toFirst(device: Device): Double = with(device) { distanceTo(localId == 0, metric = distances()) }

fun Aggregate<Int>.both(device: Device): Any? = with(device) { distances().all.toMap() to attenuations().all.toMap() }

fun Aggregate<Int>.inBranch(device: Device): Any? = with(device) { if (localId != 1) distances().neighbors.size else -1 }

/** Tests that programs can read the lengths and attenuations that the scene sets for their links. */
@CollektiveIgnore("it calls the programs")
class LinksTest {
    @Test
    fun `a gradient over the links' lengths needs no positions`() =
        onBoth { assertEquals(mapOf(0 to 0.0, 1 to 2.5, 2 to 5.5), it(Aggregate<Int>::toFirst, 4)) }

    @Test
    fun `lengths and attenuations belong to the links from the neighbours`() = onBoth {
        val lengths = mapOf(0 to 2.5, 2 to 3.0, 1 to 0.0)
        val attenuations = mapOf(0 to 0.0, 2 to 7.0, 1 to 0.0)
        assertEquals<Any?>(lengths to attenuations, it(Aggregate<Int>::both, 2)[1])
    }

    @Test
    fun `a changed length takes effect in the next round`() = onBoth { assertEquals(2.5 + 9.0, it(Aggregate<Int>::toFirst, 9)[2]) }

    @Test
    fun `in a branch only the neighbours there have a length`() =
        onBoth { assertEquals<Map<Int, Any?>>(mapOf(0 to 0, 1 to -1, 2 to 0), it(Aggregate<Int>::inBranch, 3)) }

    private fun onBoth(check: ((Aggregate<Int>.(Device) -> Any?, Int) -> Map<Int, Any?>) -> Unit) {
        for (runtime in listOf("builtIn", "collektive")) check { program, ticks -> run(runtime, program, ticks) }
    }

    /**
     * Returns the answers of the last of [ticks] ticks.
     *
     * Nodes 0, 1 and 2 are in a line. Node 1 is 2.5 m from node 0 and 3 m from node 2. The latter distance is 9 m after the fifth tick.
     */
    private fun run(runtime: String, program: Aggregate<Int>.(Device) -> Any?, ticks: Int): Map<Int, Any?> =
        TestNetwork(runtime = runtime).use { network ->
            network.add(0, 1, 2)
            network.link(0, 1, 2.5)
            network.link(1, 2, 3.0, attenuation = 7.0)
            (1..ticks).map { tick ->
                if (tick == 6) network.link(1, 2, 9.0, attenuation = 7.0)
                network.round(program)
            }.last()
        }
}
