package it.unibo.collektive.stdlib.processes

import it.unibo.collektive.stdlib.Swarm
import it.unibo.collektive.stdlib.spreading.nonStabilizingGossip
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.time.Duration
import kotlin.time.Duration.Companion.seconds
import kotlin.time.Instant

class TimeReplicatedTest {
    private fun at(seconds: Int) = Instant.fromEpochSeconds(seconds.toLong())

    @Test
    fun `a process without stabilisation follows changes when it is replicated`() {
        val swarm = Swarm(5).line(1.0, 1.0, 1.0, 1.0)
        fun second(now: Int, greatest: Int) = swarm.round {
            timeReplicated(at(now), 3, 10.seconds) {
                nonStabilizingGossip(if (localId == 0) greatest else localId) { a, b -> maxOf(a, b) }
            }
        }
        val before = (0 until 20).map { second(it, 100) }.last()
        assertEquals(setOf(100), before.values.toSet())
        val after = (20 until 20 + 3 * 10 + 15).map { second(it, 0) }.last()
        assertEquals(setOf(4), after.values.toSet(), "the former maximum must be discarded")
    }

    @Test
    fun `the result is that of the oldest replica, and each replica starts without state`() {
        val swarm = Swarm(1)
        val ages = (0 until 40).map { now -> swarm.round { timeReplicated(at(now), 2, 5.seconds) { evolve(0) { it + 1 } } }.getValue(0) }
        assertEquals((1..11).toList(), ages.take(11), "a replica must start in the round after the end of a wait")
        assertEquals(List(6) { (6..10).toList() }.flatten().take(29), ages.drop(11))
    }

    @Test
    fun `replicas start two rounds apart, even if rounds are rare`() {
        val swarm = Swarm(1)
        val ages = (1..8).map { now -> swarm.round { timeReplicated(at(now), 2, 0.8.seconds) { evolve(0) { it + 1 } } }.getValue(0) }
        assertEquals(listOf(1, 2, 3, 4, 3, 4, 3, 4), ages)
    }

    @Test
    fun `arguments out of range are refused`() {
        assertFailsWith<IllegalArgumentException> { Swarm(1).round { timeReplicated(at(0), 0, 1.seconds) { } } }
        assertFailsWith<IllegalArgumentException> { Swarm(1).round { timeReplicated(at(0), 1, Duration.ZERO) { } } }
    }
}
