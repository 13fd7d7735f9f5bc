package org.collektive.host

import org.collektive.host.shim.HostError
import org.junit.jupiter.api.AfterEach
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertNull
import kotlin.test.assertTrue

@Timeout(60)
class MetricTest {
    private val shim = TestShim()
    private val session = TestSession(shim)

    private fun open(vararg metrics: String, jar: String = ProbeJars.programs.toString(), schedule: Int = 0): Long =
        session.open(jars = listOf(jar), metrics = metrics.asList(), schedule = schedule)

    private fun tick(number: Long, vararg due: Int, isMeasured: Boolean = true) = Step(number).apply {
        if (number == 1L) {
            added = listOf(Step.Added(3), Step.Added(5), Step.Added(8))
            linked = listOf(3 to 5, 8 to 5)
        }
        this.due = due.asList()
        measures = isMeasured
    }

    @AfterEach
    fun close() {
        session.close()
    }

    @Test
    fun `metrics are measured in ticks that request them, in the order of the session's`() {
        open("links", "sensed", "answered")
        assertEquals(emptyList(), session.metrics(session.ok(tick(1, 3, 5, 8, isMeasured = false))))
        val answer = session.ok(tick(2, 3, 5, 8))
        val answered = session.answers(answer).values.sumOf { it.first }.toDouble()
        assertEquals(listOf(11.0 + 20.0, 16.0, answered).map { it to null }, session.metrics(answer))
    }

    @Test
    fun `nodes that were not due keep their answers, but have no sensor data`() {
        open("sensed", "answered", schedule = ASYNCHRONOUS)
        assertEquals(listOf(8.0, Double.NaN), session.metrics(session.ok(tick(1, 3, 5))).map { it.first })
        val before = session.metrics(session.ok(tick(2, 3, 5, 8))).last().first
        assertEquals(listOf(0.0, before), session.metrics(session.ok(tick(3))).map { it.first })
    }

    @Test
    fun `a metric that throws reports its place, and affects neither other metrics nor rounds`() {
        open("throwing", "sensed")
        val answer = session.ok(tick(1, 3, 5, 8))
        val (value, error) = session.metrics(answer)[0]
        assertTrue(value.isNaN())
        assertContains(error.orEmpty(), "IllegalStateException: no metric at 0.05\n    at probe.Metrics.throwing(Metrics.java:")
        assertEquals(16.0 to null, session.metrics(answer)[1])
        assertEquals(3, answer.nodesLength())
    }

    @Test
    fun `a metric that exceeds the time limit ends the session`() {
        open("looping")
        assertEquals(HostError.SESSION_FAILED.code.toLong(), session.step(tick(1, 3).bytes(), limitMillis = 200))
        assertContains(shim.error, "tick 1: metrics did not finish within the time limit of 200 ms (stepLimitMs)")
        assertTrue(shim.logs.any { "Metrics.looping" in it.second })
    }

    @Test
    fun `metrics do not affect the digest`() {
        fun digests(isMeasured: Boolean): List<Long> {
            open("answered", "links")
            return (1L..5).map { session.ok(tick(it, 3, 5, 8, isMeasured = isMeasured)).digest() }.also { session.close() }
        }
        assertEquals(digests(isMeasured = false), digests(isMeasured = true))
    }

    @Test
    fun `an unknown metric prevents the opening, and the error names the existing ones`() {
        assertEquals(HostError.PROGRAM.code.toLong(), open("sensd"))
        assertContains(
            shim.error,
            "unknown metric 'sensd'; the jars contain [answered, links, looping, sensed, throwing]. Correct the name",
        )
    }

    @Test
    fun `a function with another signature is not a metric`() {
        val parameters = listOf("", "String text", "NetworkSnapshot<ActuatorData, ActuatorData> network", "NetworkSnapshot network")
        for (parameter in parameters) {
            val jar = ProbeJars.withClass(
                "package probe; import org.collektive.api.*; public class Bad { @Metric(name = \"bad\") " +
                    "public static double bad($parameter) { return 0; } }",
            )
            assertEquals(HostError.PROGRAM.code.toLong(), open(jar = "$jar"), parameter)
            assertContains(
                shim.error,
                "probe.Bad.bad in $jar is not a metric of schema probe.ProbeSchema: it must be a public top-level function " +
                    "bad(network: NetworkSnapshot<probe.SensorData, probe.ActuatorData>): Double",
            )
        }
    }

    @Test
    fun `two metrics with one name are refused`() {
        val jar = ProbeJars.withClass(
            "package probe; import org.collektive.api.*; public class Bad { " +
                listOf("a", "b").joinToString("") {
                    "@Metric(name = \"same\") public static double $it(NetworkSnapshot<SensorData, ActuatorData> network) { return 0; } "
                } + "}",
        )
        assertEquals(HostError.PROGRAM.code.toLong(), open(jar = "$jar"))
        assertContains(shim.error, "two metrics are named 'same': probe.Bad.a in $jar and probe.Bad.b in $jar; rename one of them")
    }

    @Test
    fun `a reload without a measured metric keeps the previous programs`() {
        open("sensed")
        session.ok(tick(1, 3))
        val answer = session.ok(tick(2, 3).apply { reload = ProbeJars.harmless })
        assertContains(answer.reload().error().orEmpty(), "unknown metric 'sensed'; the jars contain no metrics")
        assertEquals(listOf(3.0 to null), session.metrics(answer))
    }

    @Test
    fun `after a reload, metrics see only answers of the new programs`() {
        open("answered", schedule = ASYNCHRONOUS)
        session.ok(tick(1, 3, 5, 8))
        val reloaded = session.ok(tick(2, 3).apply { reload = ProbeJars.programs })
        assertEquals(listOf(Double.NaN to null), session.metrics(reloaded))
        val (value, error) = session.metrics(session.ok(tick(3, 5, 8)))[0]
        assertTrue(value.isFinite())
        assertNull(error)
    }

    private companion object {
        const val ASYNCHRONOUS = 2
    }
}
