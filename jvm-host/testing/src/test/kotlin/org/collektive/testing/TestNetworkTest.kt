package org.collektive.testing

import it.unibo.collektive.aggregate.api.neighborhood
import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.stdlib.spreading.distanceTo
import it.unibo.collektive.stdlib.spreading.hopDistanceTo
import org.collektive.links.distances
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.TestFactory
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNotEquals

class TestNetworkTest {
    /** Returns a test for each runtime that runs [test] on a line of three nodes. */
    private fun onBoth(test: TestNetwork.() -> Unit): List<DynamicTest> = listOf("builtIn", "collektive").map { runtime ->
        dynamicTest(runtime) { TestNetwork(seed = 4, deltaTime = 0.5, runtime).use { it.line().test() } }
    }

    private fun TestNetwork.line(): TestNetwork = apply {
        add(0, 1, 2)
        link(0, 1)
        link(1, 2)
    }

    @TestFactory
    fun `a round reads what neighbours sent in the round before`() = onBoth {
        val received: List<Map<Int, Map<Int, Int>>> = List(2) { round { neighboring(localId * 10).neighbors.toMap() } }
        assertEquals(mapOf(0 to emptyMap(), 1 to emptyMap(), 2 to emptyMap()), received[0])
        assertEquals(mapOf(0 to mapOf(1 to 10), 1 to mapOf(0 to 0, 2 to 20), 2 to mapOf(1 to 10)), received[1])
    }

    @TestFactory
    fun `programs of the standard library run`() = onBoth {
        assertEquals(mapOf(0 to 0, 1 to 1, 2 to 2), rounds(4) { hopDistanceTo(localId == 0) })
    }

    @TestFactory
    fun `links have lengths, which can change`() = onBoth {
        link(1, 2, length = 2.5)
        fun run() = rounds(4) { device -> with(device) { distanceTo(localId == 0, metric = distances()) } }
        assertEquals(mapOf(0 to 0.0, 1 to 1.0, 2 to 3.5), run())
        link(0, 1, length = 4.0)
        assertEquals(mapOf(0 to 0.0, 1 to 4.0, 2 to 6.5), run())
    }

    @Test
    fun `the distance to the source is the length of the shortest path`() = TestNetwork().use { network ->
        network.add(0, 1, 2)
        network.link(0, 1, length = 2.5)
        network.link(1, 2, length = 3.0)
        val answers = network.rounds(4) { device -> with(device) { distanceTo(localId == 0, metric = distances()) } }
        assertEquals(mapOf(0 to 0.0, 1 to 2.5, 2 to 5.5), answers)
    }

    @TestFactory
    fun `nodes and links can be added and removed`() = onBoth {
        fun counts() = rounds(2) { neighborhood().neighbors.size }
        assertEquals(mapOf(0 to 1, 1 to 2, 2 to 1), counts())
        unlink(0, 1)
        assertEquals(mapOf(0 to 0, 1 to 1, 2 to 1), counts())
        remove(2)
        add(7)
        link(7, 0)
        assertEquals(setOf(0, 1, 7), nodes)
        assertEquals(mapOf(0 to 1, 1 to 0, 7 to 1), counts())
    }

    @TestFactory
    fun `links can be removed, and added again, before their node is removed`() = onBoth {
        fun counts() = round { neighborhood().neighbors.size }
        repeat(2) { counts() }
        unlink(0, 1)
        unlink(1, 2)
        link(1, 2)
        remove(1)
        assertEquals(mapOf(0 to 0, 2 to 0), counts())
        add(1)
        link(0, 1)
        unlink(0, 1)
        link(1, 2)
        repeat(2) { counts() }
        assertEquals(mapOf(0 to 0, 1 to 1, 2 to 1), counts())
        unlink(1, 2)
        link(1, 2)
        assertEquals(mapOf(0 to 0, 1 to 1, 2 to 1), counts())
    }

    @TestFactory
    fun `state lasts from round to round and ends with its node`() = onBoth {
        fun count() = round { evolve(0) { it + 1 } }
        repeat(2) { count() }
        remove(2)
        add(2)
        assertEquals(mapOf(0 to 3, 1 to 3, 2 to 1), count())
    }

    @TestFactory
    fun `a program can read its device`() = onBoth {
        add(3, mapOf("step" to "2"))
        round { }
        val answers = round { device ->
            Triple(
                device.id,
                device.time to device.deltaTime,
                if (device.id ==
                    3
                ) {
                    device.parameters["step"]
                } else {
                    ""
                },
            )
        }
        assertEquals(Triple(3, 0.5 to 0.5, "2"), answers[3])
    }

    @Test
    fun `the seed determines the random numbers`() {
        fun draw(seed: Long) = TestNetwork(seed).use {
            it.add(0)
            it.round { device -> device.random.nextLong() }
        }
        assertEquals(draw(1), draw(1))
        assertNotEquals(draw(1), draw(2))
    }

    @TestFactory
    fun `a program can return null`() = onBoth { assertEquals(mapOf(0 to null, 1 to null, 2 to null), round<Int?> { null }) }

    @TestFactory
    fun `the error of a failed round names its node, and the other rounds run`() = onBoth {
        val error = assertFailsWith<IllegalStateException> {
            round {
                if (localId == 1) throw UnsupportedOperationException("not today")
                evolve(0) { it + 1 }
            }
        }
        assertContains(error.message.orEmpty(), "node 1: java.lang.UnsupportedOperationException: not today")
        assertEquals(UnsupportedOperationException::class, error.cause?.let { it::class })
    }

    @Test
    fun `invalid calls are rejected`() = TestNetwork().line().use { network ->
        for ((text, act) in listOf<Pair<String, () -> Unit>>(
            "node 1 already exists" to { network.add(1) },
            "the id must be 0 or greater" to { network.add(-1) },
            "unknown node 9: add it first" to { network.link(0, 9) },
            "node 1 cannot be linked to itself" to { network.link(1, 1) },
            "unknown node 8" to { network.remove(8) },
            "the number of rounds is 0" to { network.rounds(0) { } },
        )) {
            assertContains(assertFailsWith<IllegalArgumentException> { act() }.message.orEmpty(), text)
        }
        assertEquals(setOf(0, 1, 2), network.round { }.keys)
    }

    @Test
    fun `the error names a missing runtime`() {
        val error = assertFailsWith<IllegalStateException> { TestNetwork(runtime = "other") }
        assertContains(error.message.orEmpty(), "the runtime other is not on the class path (found: [")
    }
}
