package org.collektive.engine

import com.sun.management.ThreadMXBean
import org.collektive.api.Parameters
import org.collektive.runtime.AggregateRuntimes
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import java.lang.management.ManagementFactory
import java.util.concurrent.TimeUnit
import kotlin.test.assertTrue

/** Tests that the engine allocates nothing per tick after a warm-up. A control run that allocates shows that the measurement works. */
@Tag("slow")
class AllocationTest {
    private val threads = ManagementFactory.getThreadMXBean() as ThreadMXBean
    private val answer = Any()

    private inner class Constant(private val allocates: Boolean) : NodeProgram {
        override val name = "constant"

        override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any = if (allocates) LongArray(4) else answer

        override fun describe(failure: Throwable, place: String?) = failure.toString()
    }

    private object NoData : RoundData {
        override fun sensors(worker: Int, index: Int): Any? = null

        override fun pack(worker: Int, index: Int, answer: Any): String? = null
    }

    @Test
    fun `no allocation per tick in steady state`() {
        val bad = NetworkModel(loss = 0.2, lossPerMetre = 1e-4, delay = 0.1, jitter = 0.5, retention = 0.4)
        for (schedule in Schedule.entries) {
            for (network in listOf(NetworkModel(), bad)) {
                val control = bytesPerTick(schedule, network, allocates = true)
                assertTrue(control > NODES * 32, "the control run must allocate at least its arrays, but only $control B were measured")
                val bytes = bytesPerTick(schedule, network, allocates = false)
                assertTrue(bytes < 1, "$schedule, ${if (network.isIdeal) "ideal" else "bad"} network: $bytes B per tick")
            }
        }
    }

    /**
     * Returns the bytes that the calling thread and the pool allocate per tick.
     *
     * This is the minimum of several runs, because code that is not compiled yet allocates more.
     */
    private fun bytesPerTick(schedule: Schedule, network: NetworkModel, allocates: Boolean): Long {
        Engine(EngineSettings(1, 2, schedule, network), AggregateRuntimes()).use { engine ->
            val tick = Tick()
            for (id in 0 until NODES) tick.nodesAdded.add(NewNode(id, Constant(allocates), Parameters(emptyMap())))
            val links = LinkList()
            tick.links = links
            fun step() {
                tick.number++
                tick.time += 0.1
                for (id in 0 until NODES) tick.due.add(id)
                for (part in 1 until NODES / 10) links.add(10 * part - 1, 10 * part, tick.time.toFloat(), 0f)
                engine.step(tick, NoData, System.nanoTime() + TimeUnit.SECONDS.toNanos(10))
                tick.clear()
                links.clear()
                tick.links = links
            }
            repeat(WARM_UP) { step() }
            val own = Thread.getAllStackTraces().keys.filter { it is RoundThread || it === Thread.currentThread() }
            val ids = own.map { it.id }.toLongArray()
            return (1..RUNS).minOf {
                val before = threads.getThreadAllocatedBytes(ids).sum()
                repeat(TICKS) { step() }
                (threads.getThreadAllocatedBytes(ids).sum() - before) / TICKS
            }
        }
    }

    private companion object {
        const val NODES = 500
        const val WARM_UP = 500
        const val TICKS = 1000
        const val RUNS = 5
    }
}
