package org.collektive.host

import org.collektive.frame.Inspection
import org.collektive.frame.StepResponse
import org.collektive.host.shim.HostError
import org.junit.jupiter.api.AfterEach
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** Tests the inspection of single nodes: their stored values and the time of their last round. */
@Timeout(60)
class InspectionTest {
    private val shim = TestShim()
    private val session = TestSession(shim)

    private fun open(body: String, members: String = "") {
        val jar = ProbeJars.withClass(
            """
            package probe;
            import it.unibo.collektive.aggregate.api.*;
            import org.collektive.api.*;
            public final class Inspected {
              @Program(name = "sum")
              public static ActuatorData sum(Aggregate<Integer> aggregate, SensorData sensors, Device device) {
                $body
                return new ActuatorData(0, "");
              }
              static void keep(Aggregate<Integer> aggregate, String path, Object value) {
                aggregate.alignedOn(path, () -> aggregate.<Object>evolve(value, x -> value));
              }
              $members
            }
            """,
            "Inspected",
        )
        check(session.open(listOf(jar.toString()), schedule = ASYNCHRONOUS) >= 0) { shim.error }
    }

    private fun step(tick: Long, inspected: Int, vararg due: Int) = Step(tick).also {
        if (tick == 1L) it.added = listOf(Step.Added(1), Step.Added(2))
        it.due = due.asList()
        it.inspected = inspected
    }

    private fun inspection(tick: Long, inspected: Int, vararg due: Int): Inspection? = session.ok(step(tick, inspected, *due)).inspection()

    private fun state(inspection: Inspection?): List<Pair<String, String>> =
        assertNotNull(inspection).let { List(it.stateLength()) { index -> it.state(index).path() to it.state(index).value() } }

    @AfterEach
    fun close() = session.close()

    @Test
    fun `a value that is cut within a surrogate pair`() {
        open("""keep(aggregate, "a", "x".repeat(119) + "\ud83d\ude00");""")
        assertEquals("x".repeat(119) + "?…", state(inspection(1, 1, 1)).single().second)
    }

    @Test
    fun `the state and the last round of the requested node only`() {
        open("""keep(aggregate, "b", device.getId()); keep(aggregate, "a", "text"); keep(aggregate, "c", null);""")
        assertNull(inspection(1, -1, 1, 2))
        val second = assertNotNull(inspection(2, 2, 1, 2))
        assertEquals(2, second.node())
        assertEquals(listOf("a" to "text", "b" to "2", "c" to "null"), state(second))
        assertTrue(second.roundNanos() > 0)
        assertEquals(second.roundNanos(), inspection(3, 2, 1)?.roundNanos(), "the time must stay the same, because the node was not due")
        assertEquals(0, inspection(4, 1, 2)?.roundNanos(), "the node has not run a round since its inspection began")
        assertNull(inspection(5, 7, 1, 2), "an unknown node must have no inspection")
    }

    @Test
    fun `values at calls of the same function have the lines of the calls`() {
        val token = { line: Int -> "keep@Probe.kt:$line#0123456789abcde$line" }
        open("""keep(aggregate, "${token(1)}", "first"); keep(aggregate, "${token(2)}", "second"); keep(aggregate, "a", "third");""")
        assertEquals(listOf("a" to "third", "keep (Probe.kt:1)" to "first", "keep (Probe.kt:2)" to "second"), state(inspection(1, 1, 1)))
    }

    @Test
    fun `texts are shortened, and a value without a text shows its class`() {
        open(
            """
            keep(aggregate, "long", "x".repeat(1000)); keep(aggregate, "object", new Plain());
            keep(aggregate, "throwing", new Throwing());
            """,
            """
            static final class Plain {}
            static final class Throwing { @Override public String toString() { throw new IllegalStateException(); } }
            """,
        )
        val failure = "toString() failed: java.lang.IllegalStateException"
        val expected = listOf("long" to "x".repeat(120) + "…", "object" to "Plain", "throwing" to failure)
        assertEquals(expected, state(inspection(1, 1, 1)))
    }

    @Test
    fun `at most 200 values`() {
        open("""for (int i = 0; i < 300; i++) keep(aggregate, "path " + i, i);""")
        assertEquals(200, state(inspection(1, 1, 1)).size)
    }

    @Test
    fun `a text that exceeds the time limit ends the session`() {
        open(
            """keep(aggregate, "looping", new Looping());""",
            "static final class Looping { @Override public String toString() { while (true) Thread.onSpinWait(); } }",
        )
        assertEquals(HostError.SESSION_FAILED.code.toLong(), session.step(step(1, 1, 1).bytes(), limitMillis = 200))
        assertContains(shim.error, "tick 1: the inspection did not finish within the time limit of 200 ms (stepLimitMs)")
    }

    @Test
    fun `inspections do not affect the digest`() {
        fun digests(inspected: Int): List<Long> {
            open("""keep(aggregate, "a", device.getRandom().nextInt());""")
            return (1L..5).map { session.ok(step(it, inspected, 1, 2)).let(StepResponse::digest) }.also { session.close() }
        }
        assertEquals(digests(-1), digests(1))
    }

    private companion object {
        const val ASYNCHRONOUS = 2
    }
}
