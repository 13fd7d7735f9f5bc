package org.collektive.host.jfr

import org.collektive.host.Step
import org.collektive.host.TestSession
import org.collektive.host.TestShim
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import kotlin.test.assertTrue

/** Tests that events cost almost nothing while no recording is running. */
@Timeout(120)
class EventCostTest {
    @Test
    fun `the check for a recording costs little compared with a round`() {
        val check = (1..5).minOf { nanosPer(CHECKS) { repeat(CHECKS) { if (RoundSampling.begin() != null) sampled++ } } }
        val session = TestSession(TestShim()).apply { open(program = "probe", threads = 1) }
        val nodes = (0 until NODES).toList()
        session.ok(
            Step(1).apply {
                added = nodes.map { Step.Added(it) }
                due = nodes
            },
        )
        var tick = 2L
        val round = (1..5).minOf { nanosPer(TICKS * NODES) { repeat(TICKS) { session.ok(Step(tick++).apply { due = nodes }) } } }
        session.close()
        println("  %.2f ns per check, %.0f ns per round with its share of the tick: %.2f %%".format(check, round, 100 * check / round))
        assertTrue(sampled == 0L, "no round may be sampled without a recording")
        assertTrue(check < round / 20, "a check must take less than 1/20 of a round: it takes $check ns, and a round takes $round ns")
    }

    private var sampled = 0L

    private inline fun nanosPer(count: Int, work: () -> Unit): Double {
        val begin = System.nanoTime()
        work()
        return (System.nanoTime() - begin).toDouble() / count
    }

    private companion object {
        const val CHECKS = 20_000_000
        const val NODES = 200
        const val TICKS = 200
    }
}
