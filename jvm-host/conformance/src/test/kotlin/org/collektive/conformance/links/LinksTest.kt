package org.collektive.conformance.links

import it.unibo.collektive.aggregate.api.Aggregate
import it.unibo.collektive.aggregate.api.CollektiveIgnore
import it.unibo.collektive.aggregate.toMap
import it.unibo.collektive.stdlib.spreading.distanceTo
import org.collektive.api.Device
import org.collektive.api.Parameters
import org.collektive.engine.Engine
import org.collektive.engine.EngineSettings
import org.collektive.engine.LinkList
import org.collektive.engine.NewNode
import org.collektive.engine.NodeProgram
import org.collektive.engine.RoundData
import org.collektive.engine.RoundDevice
import org.collektive.engine.Schedule
import org.collektive.engine.Tick
import org.collektive.links.attenuations
import org.collektive.links.distances
import org.collektive.mailbox.MailboxRuntimes
import org.collektive.runtime.AggregateRuntimes
import org.collektive.spi.DeviceRuntimes
import kotlin.test.Test
import kotlin.test.assertEquals

fun Aggregate<Int>.toFirst(device: Device): Double = with(device) { distanceTo(localId == 0, metric = distances()) }

fun Aggregate<Int>.both(device: Device): Any? = with(device) { distances().all.toMap() to attenuations().all.toMap() }

fun Aggregate<Int>.inBranch(device: Device): Any? = with(device) { if (localId != 1) distances().neighbors.size else -1 }

/** Programs know the lengths and attenuations of their links as the scene gives them. */
@CollektiveIgnore("it drives the programs")
class LinksTest {
    @Test
    fun `a gradient over the links' lengths needs no positions`() =
        onBoth { assertEquals(mapOf(0 to 0.0, 1 to 2.5, 2 to 5.5), it(Aggregate<Int>::toFirst, 4)) }

    @Test
    fun `lengths and attenuations are those of the links from the neighbours`() = onBoth {
        val lengths = mapOf(0 to 2.5, 2 to 3.0, 1 to 0.0)
        val attenuations = mapOf(0 to 0.0, 2 to 7.0, 1 to 0.0)
        assertEquals<Any?>(lengths to attenuations, it(Aggregate<Int>::both, 2)[1])
    }

    @Test
    fun `a changed length counts from the next round`() = onBoth { assertEquals(2.5 + 9.0, it(Aggregate<Int>::toFirst, 9)[2]) }

    @Test
    fun `in a branch only the neighbours there have a length`() =
        onBoth { assertEquals<Map<Int, Any?>>(mapOf(0 to 0, 1 to -1, 2 to 0), it(Aggregate<Int>::inBranch, 3)) }

    private fun onBoth(check: ((Aggregate<Int>.(Device) -> Any?, Int) -> Map<Int, Any?>) -> Unit) {
        for (runtimes in listOf<() -> DeviceRuntimes>({ AggregateRuntimes() }, { MailboxRuntimes() })) {
            check { program, ticks -> run(runtimes(), program, ticks) }
        }
    }

    /** The answers of the last of [ticks]. The line is 0 - 2.5 m - 1 - 3 m - 2; from the sixth tick on its second link has 9 m. */
    private fun run(runtimes: DeviceRuntimes, program: Aggregate<Int>.(Device) -> Any?, ticks: Int): Map<Int, Any?> =
        Engine(EngineSettings(1, 1, Schedule.LOCKSTEP), runtimes).use { engine ->
            (1..ticks).map { number ->
                val tick = Tick().apply {
                    this.number = number.toLong()
                    if (number == 1) (0..2).forEach { nodesAdded += NewNode(it, Rounds(program), Parameters(emptyMap<String, String>())) }
                    if (number == 1) links = line(3f)
                    if (number == 6) links = line(9f)
                    (0..2).forEach(due::add)
                }
                val result = engine.step(tick, NoSensors, System.nanoTime() + 10_000_000_000)
                (0..2).associateWith { id -> result.failure(id)?.let { error(it) } ?: result.answer(id) }
            }.last()
        }

    private fun line(second: Float) = LinkList().apply {
        add(0, 1, 2.5f, 0f)
        add(1, 0, 2.5f, 0f)
        add(1, 2, second, 7f)
        add(2, 1, second, 7f)
    }

    private class Rounds(private val program: Aggregate<Int>.(Device) -> Any?) : NodeProgram {
        override val name = "links"

        @Suppress("UNCHECKED_CAST")
        override fun round(aggregate: Any, sensors: Any?, device: RoundDevice): Any? = program(aggregate as Aggregate<Int>, device)

        override fun describe(failure: Throwable, place: String?) = "$failure $place"
    }

    private object NoSensors : RoundData {
        override fun sensors(worker: Int, index: Int): Any? = null

        override fun pack(worker: Int, index: Int, answer: Any): String? = null
    }
}
