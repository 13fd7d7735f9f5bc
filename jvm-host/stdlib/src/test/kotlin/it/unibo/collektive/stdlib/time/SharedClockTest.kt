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
    fun `the clock starts in the distant past and follows the device that ran longest`() {
        val swarm = Swarm(2).line(1.0)
        var seen = emptyMap<Int, Instant>()
        for (second in 0..4) seen = swarm.round { sharedClock(at(1000 * localId + second)) }
        val late = swarm.add()
        swarm.link(1, late)
        for (second in 5..9) seen = swarm.round { sharedClock(at(1000 * localId + second)) }
        assertEquals(Instant.DISTANT_PAST + 9.seconds, seen.getValue(0))
        assertTrue(seen.values.all { it >= Instant.DISTANT_PAST + 8.seconds }, "$seen")
    }

    @Test
    fun `a wait that is over starts again`() {
        val swarm = Swarm(1)
        val seen = (0..7).map { second -> swarm.round { sharedTimeLeftTo(at(second), 3.seconds) }.getValue(0) }
        assertEquals(listOf(3, 2, 1, 0, 2, 1, 0, 2).map { it.seconds }, seen)
    }

    @Test
    fun `a device that joins later starts its wait when it joins`() {
        val swarm = Swarm(2).line(1.0)
        var seen = emptyMap<Int, Duration>()
        for (second in 0 until 6) seen = swarm.round { sharedTimeLeftTo(at(second), 10.seconds) }
        val late = swarm.add()
        swarm.link(0, late)
        for (second in 6 until 9) seen = swarm.round { sharedTimeLeftTo(at(second), 10.seconds) }
        assertEquals(mapOf(0 to 2.seconds, 1 to 2.seconds, late to 8.seconds), seen)
    }
}
