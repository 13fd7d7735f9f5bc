package org.collektive.engine

import it.unibo.collektive.aggregate.api.neighboring
import it.unibo.collektive.aggregate.toMap
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.TestFactory
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

/** Tests that an invalid tick is rejected without an effect. The message names the tick, the id and the value. */
class InvalidTicksTest {
    private class Case(val message: String, val fill: TestEngine.(Tick) -> Unit)

    private val cases = listOf(
        Case("tick 7: expected tick 3") { it.number = 7 },
        Case("tick 2: expected tick 3") { it.number = 2 },
        Case("tick 3: the time is NaN; it must be finite") { it.time = Double.NaN },
        Case("tick 3: the time is Infinity; it must be finite") { it.time = Double.POSITIVE_INFINITY },
        Case("tick 3: the delta time is NaN; it must be finite and 0 or greater") { it.deltaTime = Double.NaN },
        Case("tick 3: the delta time is -0.5; it must be finite and 0 or greater") { it.deltaTime = -0.5 },
        Case("tick 3: node 9 cannot be removed: unknown node") { it.nodesRemoved.add(9) },
        Case("tick 3: node 1 is removed twice") { tick -> repeat(2) { tick.nodesRemoved.add(1) } },
        Case("tick 3: node -1 cannot be added: the id must be 0 or greater") { it.add(-1) },
        Case("tick 3: node 2 cannot be added: the id is already in use") { it.add(2) },
        Case("tick 3: node 8 is added twice") { it.add(8, 7, 8) },
        Case("tick 3: node 9 cannot be changed: unknown node") { it.change(9) },
        Case("tick 3: node 2 cannot be changed: unknown node") {
            it.nodesRemoved.add(2)
            it.change(2)
        },
        Case("tick 3: link 1 -> 9 cannot be removed: unknown link") { it.unlink(1, 9) },
        Case("tick 3: link 2 -> 1 cannot be removed: unknown link") { it.unlink(2, 1) },
        Case("tick 3: link 1 -> 2 is removed twice") { tick -> repeat(2) { tick.unlink(1, 2) } },
        Case("tick 3: link 1 -> 2 cannot be removed: unknown link") {
            it.nodesRemoved.add(2)
            it.unlink(1, 2)
        },
        Case("tick 3: node 1 cannot be linked to itself") { it.link(1, 1) },
        Case("tick 3: link 9 -> 1: unknown node 9") { it.link(9, 1) },
        Case("tick 3: link 1 -> 9: unknown node 9") { it.link(1, 9) },
        Case("tick 3: link 1 -> 2: unknown node 2") {
            it.nodesRemoved.add(2)
            it.link(1, 2)
        },
        Case("tick 3: link 1 -> 2 has length NaN; it must be finite and 0 or greater") { it.link(1, 2, Float.NaN, 0f) },
        Case("tick 3: link 1 -> 2 has length -1.0; it must be finite and 0 or greater") { it.link(1, 2, -1f, 0f) },
        Case("tick 3: link 1 -> 2 has attenuation -2.0; it must be finite and 0 or greater") { it.link(1, 2, 1f, -2f) },
        Case("tick 3: link 1 -> 2 has attenuation Infinity; it must be finite and 0 or greater") {
            it.link(1, 2, 1f, Float.POSITIVE_INFINITY)
        },
        Case("tick 3: link 1 -> 2 is updated twice") { tick -> repeat(2) { tick.link(1, 2) } },
        Case("tick 3: link 3 -> 1 is added twice") { tick ->
            tick.link(3, 1)
            tick.link(2, 1)
            tick.link(3, 1)
        },
        Case("tick 3: link 1 -> 2 is added twice") { tick ->
            tick.unlink(1, 2)
            repeat(2) { tick.link(1, 2) }
        },
        Case("tick 3: due node 9: unknown node") { it.due(1, 9) },
        Case("tick 3: due node 1 comes after 2; due ids must be in ascending order without duplicates") { it.due(2, 1) },
        Case("tick 3: due node 1 comes after 1; due ids must be in ascending order without duplicates") { it.due(1, 1) },
        Case("tick 3: due node -5 comes after -1; due ids must be in ascending order without duplicates") { it.due(-5) },
        Case("tick 3: due node 2: unknown node") {
            it.nodesRemoved.add(2)
            it.due(1, 2)
        },
    )

    @TestFactory
    fun `an invalid tick changes nothing`(): List<DynamicTest> = cases.map { case ->
        DynamicTest.dynamicTest(case.message) {
            assertEquals(run(bad = null), run(bad = case))
        }
    }

    /** Runs four ticks. Before the third one, runs the bad tick together with changes that must not be applied. */
    private fun run(bad: Case?): List<Any?> {
        val program = program { device -> evolveAll(device.time) to device.time }
        return TestEngine(program).use { test ->
            with(test) {
                step {
                    add(1, 2, 3)
                    link(1, 2)
                    due(1, 2, 3)
                }
                val second = step { due(1, 2, 3) }.toMap()
                if (bad != null) {
                    val error = assertFailsWith<InvalidTickException> {
                        step {
                            nodesRemoved.add(3)
                            add(3, 100)
                            link(100, 1)
                            globals = "never"
                            bad.fill(test, this)
                        }
                    }
                    assertEquals(bad.message, error.message)
                }
                val third = step {
                    unlink(1, 2)
                    link(3, 2)
                    due(1, 2, 3)
                }.toMap()
                val last = step { due(1, 2, 3) }
                listOf(second, third, last.toMap(), last.nodeCount, last.linkCount)
            }
        }
    }

    private fun it.unibo.collektive.aggregate.api.Aggregate<Int>.evolveAll(time: Double) = listOf(
        alignedOn("count") { evolve(0) { it + 1 } },
        alignedOn("near") { neighboring(localId + time).neighbors.toMap() },
    )
}
