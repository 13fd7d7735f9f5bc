package it.unibo.collektive.stdlib.time

import it.unibo.collektive.stdlib.Swarm
import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue
import kotlin.time.Duration
import kotlin.time.Duration.Companion.seconds
import kotlin.time.Instant

class SharedClockTest {
    private fun at(seconds: Int) = Instant.fromEpochSeconds(seconds.toLong())

    @Test
    fun `localDeltaTime is the time between rounds, never negative`() {
        val swarm = Swarm(1)
        val seen = listOf(10, 13, 13, 8, 9).map { now -> swarm.round { localDeltaTime(at(now)) }.getValue(0) }
        assertEquals(listOf(0, 3, 0, 0, 1).map { it.seconds }, seen)
    }

    @Test
    fun `every clock follows the fastest one`() {
        val swarm = Swarm(3).line(1.0, 1.0)
        var seen = emptyMap<Int, Instant>()
        for (second in 0 until 10) seen = swarm.round { sharedClock(at(1000 * localId + second)) }
        assertEquals(at(2009), seen.getValue(2))
        assertTrue(seen.values.all { it >= at(2007) }, "$seen")
    }

    @Test
    fun `all devices wait for the same moment, also those that come later`() {
        val swarm = Swarm(2).line(1.0)
        var seen = emptyMap<Int, Duration>()
        for (second in 0 until 6) seen = swarm.round { sharedTimeLeftTo(at(second), 10.seconds) }
        val late = swarm.add()
        swarm.link(0, late)
        for (second in 6 until 9) seen = swarm.round { sharedTimeLeftTo(at(second), 10.seconds) }
        assertEquals(2.seconds, seen.getValue(0))
        assertTrue(seen.getValue(late) <= 3.seconds, "$seen")
        for (second in 9 until 15) seen = swarm.round { sharedTimeLeftTo(at(second), 10.seconds) }
        assertEquals(setOf(Duration.ZERO), seen.values.toSet())
    }
}
