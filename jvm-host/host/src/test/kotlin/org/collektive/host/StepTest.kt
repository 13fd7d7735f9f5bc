package org.collektive.host

import org.collektive.host.shim.HostError
import org.junit.jupiter.api.AfterEach
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

@Timeout(60)
class StepTest {
    private val shim = TestShim()
    private val sessions = ArrayList<TestSession>()

    private fun session(program: String = "sum", threads: Int = 2, schedule: Int = 0, network: List<Double>? = null): TestSession {
        val session = TestSession(shim)
        check(session.open(program = program, threads = threads, schedule = schedule, network = network) >= 0) { shim.error }
        sessions.add(session)
        return session
    }

    @AfterEach
    fun closeAll() = sessions.forEach(TestSession::close)

    private fun nodes(vararg ids: Int) = ids.map { Step.Added(it) }

    @Test
    fun `answers come in id order, with counts and times`() {
        val session = session()
        session.ok(
            Step(1).apply {
                added = nodes(5, 2, 9)
                linked = listOf(2 to 5, 9 to 5)
                due = listOf(2, 5, 9)
            },
        )
        val answer = session.ok(Step(2).apply { due = listOf(2, 5, 9) })
        assertEquals(2, answer.tick())
        assertEquals(3, answer.nodeCount())
        assertEquals(2, answer.linkCount())
        assertEquals(listOf(2, 5, 9), List(answer.nodesLength()) { answer.nodes(it) })
        val values = session.answers(answer).mapValues { it.value.first }
        assertEquals(mapOf(2 to 2L, 5 to (5L * 31 + 2) * 31 + 9, 9 to 9L), values)
        assertTrue(answer.hostMicros() >= answer.roundMicros())
    }

    @Test
    fun `a tick without due nodes is an answer without nodes`() {
        val answer = session().ok(Step(1).apply { sensors = emptyList() })
        assertEquals(0, answer.nodesLength())
        assertEquals(0, answer.errorsLength())
    }

    @Test
    fun `equal seeds and inputs give equal digests for any number of threads`() {
        val runs = listOf(1, 2, 8).map { digests(session(threads = it)) }
        assertEquals(runs[0], runs[1])
        assertEquals(runs[0], runs[2])
        val changed = digests(session(), changedTick = 7)
        assertEquals(runs[0].take(6), changed.take(6))
        for (tick in 6 until 20) assertNotEquals(runs[0][tick], changed[tick])
        assertNotEquals(runs[0], digests(session(schedule = 1)))
    }

    @Test
    fun `the order of changes does not affect the digest, under any schedule and network`() {
        val bad = listOf(0.2, 0.01, 0.0, 0.05, 0.2, 0.3)
        val digests = HashSet<List<Long>>()
        for (schedule in 0..2) {
            for (network in listOf(null, bad)) {
                val expected = digests(session(threads = 1, schedule = schedule, network = network))
                for (threads in listOf(1, 2, 4, 8)) {
                    val session = session(threads = threads, schedule = schedule, network = network)
                    assertEquals(
                        expected,
                        digests(session, order = Random(threads)),
                        "$threads threads, schedule $schedule, network $network",
                    )
                }
                digests += expected
            }
        }
        assertEquals(3, digests.size, "asynchronous and lockstep must agree, and a delayed message must not arrive in its own tick")
    }

    @Test
    fun `the answer counts messages`() {
        val session = session(network = listOf(1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
        val answer = session.ok(
            Step(1).apply {
                added = nodes(1, 2, 3)
                linked = listOf(1 to 2, 1 to 3)
                due = listOf(1)
            },
        )
        assertEquals(listOf(2, 2, 0, 0), listOf(answer.sent(), answer.dropped(), answer.delayed(), answer.expired()))
        val slow = session(network = listOf(0.0, 0.0, 0.0, 0.06, 0.0, 0.05))
        slow.ok(
            Step(1).apply {
                added = nodes(1, 2)
                linked = listOf(1 to 2)
                due = listOf(1)
            },
        )
        val counts = (2L..5L).map { tick -> slow.ok(Step(tick).apply { sensors = emptyList() }).expired() }
        assertEquals(listOf(0, 0, 1, 0), counts)
    }

    private fun digests(session: TestSession, changedTick: Int = 0, order: Random? = null): List<Long> {
        val ids = (0 until 200).toList()
        fun <T> List<T>.arriving() = if (order == null) this else shuffled(order)
        return (1..20).map { tick ->
            session.ok(
                Step(tick.toLong()).apply {
                    if (tick == 1) {
                        added = ids.map { Step.Added(it) }.arriving()
                        linked = (ids.zipWithNext() + ids.zipWithNext { a, b -> b to a }).arriving()
                    }
                    if (tick == 10) {
                        removed = ids.filter { it % 7 == 0 }.arriving()
                        added = ids.filter { it % 14 == 0 }.map { Step.Added(it) }.arriving()
                        linked = ids.filter { it % 14 == 0 && it > 0 }.map { it - 1 to it }.arriving()
                        unlinked = ids.filter { it % 7 == 2 }.map { it to it + 1 }.filter { it.second < 200 }.arriving()
                    }
                    due = ids.filter { (it + tick) % 3 != 0 && (tick < 10 || it % 7 != 0 || it % 14 == 0) }
                    sensors = due.map { Step.Sensor(it * tick + if (tick == changedTick && it == 100) 1 else 0) }
                },
            ).digest()
        }
    }

    @Test
    fun `global data stays until the next, and refused ticks do not change it`() {
        val session = session()
        fun texts(step: Step) = session.answers(session.ok(step)).getValue(1).second.orEmpty().substringAfterLast('/')
        assertEquals(
            "calm",
            texts(
                Step(1).apply {
                    added = nodes(1)
                    due = listOf(1)
                },
            ),
        )
        assertEquals(
            "2.5",
            texts(
                Step(2).apply {
                    wind = 2.5f
                    due = listOf(1)
                },
            ),
        )
        // Global data has two buffers, so only a second refused tick could overwrite the current data.
        repeat(2) {
            assertEquals(
                -12,
                session.step(
                    Step(3).apply {
                        wind = 9f
                        due = listOf(8)
                    }.bytes(),
                ),
            )
        }
        assertEquals("2.5", texts(Step(3).apply { due = listOf(1) }))
        assertEquals(
            "3.5",
            texts(
                Step(4).apply {
                    wind = 3.5f
                    due = listOf(1)
                },
            ),
        )
    }

    @Test
    fun `a failed round is reported with its node, its program and the lines of its code`() {
        val labels = mapOf(
            "throw" to "java.lang.IllegalStateException: broken in two lines [node 2 at root]\n    at probe.Programs.probe(Programs.java:",
            "throw-surrogate" to "java.lang.IllegalStateException: half ? [node 2 at root]",
            "recurse" to "java.lang.StackOverflowError: infinite recursion [node 2 at deeper > deeper > ",
            "memory" to "java.lang.OutOfMemoryError",
            "exit" to "java.lang.SecurityException: System.exit is refused",
            "null" to "the program returned null",
            "surrogate" to "text contains an unpaired surrogate",
            "share-view" to "a probe.SensorData is a view of the frame's memory",
            "keep-view" to "a probe.SensorData is a view of the frame's memory",
        )
        val session = session(program = "probe")
        session.ok(
            Step(1).apply {
                added = nodes(1, 2, 3)
                due = listOf(1, 2, 3)
            },
        )
        var tick = 2L
        for ((label, message) in labels) {
            val answer = session.ok(
                Step(tick++).apply {
                    due = listOf(1, 2, 3)
                    sensors = listOf(Step.Sensor(0), Step.Sensor(0, label), Step.Sensor(0))
                },
            )
            assertEquals(listOf(1, 3), List(answer.nodesLength()) { answer.nodes(it) }, label)
            assertEquals(1, answer.errorsLength())
            assertEquals("probe", answer.errors(0).program())
            assertContains(session.errors(answer).getValue(2), message)
            assertFalse("LambdaForm" in session.errors(answer).getValue(2), "the stack trace must contain only the user's own lines")
        }
        val last = session.answers(session.ok(Step(tick).apply { due = listOf(1, 2, 3) })).mapValues { it.value.first }
        assertEquals(mapOf(1 to labels.size + 2L, 2 to 2L, 3 to labels.size + 2L), last, "failed rounds must not count")
    }

    @Test
    fun `an answer too large for its slot grows it, and no round runs twice`() {
        val session = session(program = "probe")
        session.ok(
            Step(1).apply {
                added = nodes(1, 2)
                due = listOf(1, 2)
            },
        )
        val answers = session.answers(
            session.ok(
                Step(2).apply {
                    due = listOf(1, 2)
                    sensors = listOf(Step.Sensor(0, "text:100000"), Step.Sensor(0))
                },
            ),
        )
        assertEquals(2L to "x".repeat(100_000), answers[1])
        assertEquals(2L, answers.getValue(2).first)
        assertEquals(3L, session.answers(session.ok(Step(3).apply { due = listOf(1, 2) })).getValue(1).first)
    }

    @Test
    fun `without memory for the answer the session fails with a clear message`() {
        val session = session(program = "probe")
        session.ok(
            Step(1).apply {
                added = nodes(1)
                due = listOf(1)
            },
        )
        shim.memoryLeft = 4096
        val step = Step(2).apply {
            due = listOf(1)
            sensors = listOf(Step.Sensor(0, "text:100000"))
        }
        assertEquals(HostError.SESSION_FAILED.code.toLong(), session.step(step.bytes()))
        assertContains(shim.error, "cannot allocate native memory")
        assertEquals(HostError.SESSION_FAILED.code.toLong(), session.step(Step(3).bytes()))
    }

    @Test
    fun `an endless round fails the session, and the next session runs`() {
        val session = session(program = "probe")
        session.ok(
            Step(1).apply {
                added = nodes(1, 2)
                due = listOf(1, 2)
            },
        )
        val endless = Step(2).apply {
            due = listOf(1, 2)
            sensors = listOf(Step.Sensor(0), Step.Sensor(0, "loop"))
        }
        assertEquals(HostError.SESSION_FAILED.code.toLong(), session.step(endless.bytes(), limitMillis = 300))
        assertContains(shim.error, "tick 2: rounds did not finish within the time limit of 300 ms (stepLimitMs)")
        assertTrue(shim.logs.any { "in the round of node 2" in it.second })
        assertTrue(shim.logs.any { "probe.Programs.probe(Programs.java:" in it.second })
        assertEquals(HostError.SESSION_FAILED.code.toLong(), session.step(Step(2).bytes()))
        session().ok(
            Step(1).apply {
                added = nodes(1)
                due = listOf(1)
            },
        )
    }

    @Test
    fun `an invalid request is refused, and the message names the reason`() {
        val session = session()
        session.ok(
            Step(1).apply {
                added = nodes(1, 2)
                linked = listOf(1 to 2)
                due = listOf(1, 2)
            },
        )
        val cases = listOf<Triple<Int, String, Step.() -> Unit>>(
            Triple(-12, "tick 2: node 7 cannot be removed: unknown node") { removed = listOf(7) },
            Triple(-12, "tick 2: due node 7: unknown node") { due = listOf(7) },
            Triple(-12, "sensor data has 1 elements, but 2 nodes are due") {
                due = listOf(1, 2)
                sensors = listOf(Step.Sensor(1))
            },
            Triple(-12, "tick 2: the time is NaN") { time = Double.NaN },
            Triple(-14, "node 3: unknown program 'smu'; the jars contain") { added = listOf(Step.Added(3, "smu")) },
            Triple(-14, "node 3 sets the parameter 'speed', which program 'sum' does not declare") {
                added = listOf(Step.Added(3, "sum", mapOf("speed" to "1")))
            },
        )
        for ((code, message, fill) in cases) {
            assertEquals(code.toLong(), session.step(Step(2).apply(fill).bytes()))
            assertContains(shim.error, message)
        }
        assertEquals(-12, session.step(Step(3).bytes()))
        assertContains(shim.error, "tick 3: expected tick 2")
        assertEquals(2, session.ok(Step(2)).nodeCount())
    }

    @Test
    fun `each node may have its own program`() {
        val session = session(program = "")
        assertEquals(HostError.PROGRAM.code.toLong(), session.step(Step(1).apply { added = nodes(1) }.bytes()))
        assertContains(shim.error, "node 1 has no program, and the session has no default program; set one of them")
        val answers = session.answers(
            session.ok(
                Step(1).apply {
                    added = listOf(Step.Added(1, "sum"), Step.Added(2, "probe"))
                    due = listOf(1, 2)
                },
            ),
        )
        assertEquals(listOf(true, false), listOf(1, 2).map { answers.getValue(it).second != null })
    }
}
