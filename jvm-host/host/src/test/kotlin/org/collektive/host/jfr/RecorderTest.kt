package org.collektive.host.jfr

import jdk.jfr.consumer.RecordedEvent
import jdk.jfr.consumer.RecordingFile
import org.collektive.frame.RecordingAction
import org.collektive.frame.RecordingState
import org.collektive.host.Step
import org.collektive.host.TestControl
import org.collektive.host.TestSession
import org.collektive.host.TestShim
import org.junit.jupiter.api.AfterEach
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.exists
import kotlin.io.path.writeText
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** Tests flight recordings, from the control frame that starts a recording to the events in its file. */
@Timeout(120)
class RecorderTest {
    @TempDir
    lateinit var folder: Path
    private val shim = TestShim()
    private val control = TestControl(shim)

    @AfterEach
    fun stop() {
        control.record(RecordingAction.Stop)
    }

    @Test
    fun `a recording contains all ticks, the sampled rounds, the errors, and start and end of the session`() {
        val file = folder.resolve("new/swarm.jfr")
        assertEquals(RecordingState.On, start(file).recording())
        val session = TestSession(shim, answerBytes = 128)
        session.open(program = "sum", threads = 1)
        val nodes = (0 until NODES).toList()
        session.ok(
            Step(1).apply {
                added = nodes.map { Step.Added(it) }
                linked = listOf(1 to 2, 2 to 3)
                due = nodes
            },
        )
        for (tick in 2..TICKS) session.ok(Step(tick).apply { due = nodes })
        session.close()
        val failing = TestSession(shim).apply { open(program = "probe") }
        failing.ok(
            Step(1).apply {
                added = listOf(Step.Added(5))
                due = listOf(5)
                sensors = listOf(Step.Sensor(0, "throw"))
            },
        )
        failing.close()
        control.record(RecordingAction.Stop)

        val events = read(file)
        val ticks = events.getValue("collektive.Tick").sortedBy { it.startTime }
        assertEquals(TICKS + 1, ticks.size.toLong())
        val last = ticks[TICKS.toInt() - 1]
        assertEquals(TICKS, last.getLong("tick"))
        assertEquals(listOf(NODES, NODES, 0, 2), listOf("nodes", "dueNodes", "failedRounds", "links").map(last::getInt))
        assertTrue(last.getLong("bytesIn") > NODES * 4 && last.getLong("bytesOut") > NODES * 4)
        assertTrue(last.getDuration("wait").toNanos() > 0 && last.getDuration("write").toNanos() > 0)
        assertTrue(last.getDuration("rounds") < last.duration)
        assertEquals(1, ticks.last().getInt("failedRounds"))

        val network = events.getValue("collektive.NetworkStats").sortedBy { it.startTime }.take(TICKS.toInt())
        assertEquals((1..TICKS).toList(), network.map { it.getLong("tick") })
        assertEquals(listOf(2L, 0L, 0L, 0L), listOf("sent", "dropped", "delayed", "expired").map(network.last()::getLong))

        val rounds = events.getValue("collektive.ProgramRound").filter { it.getString("program") == "sum" }
        assertEquals((TICKS * NODES + RoundSampling.INTERVAL - 1) / RoundSampling.INTERVAL, rounds.size.toLong())
        assertEquals(nodes, rounds.map { it.getInt("node") }.distinct().sorted())
        assertEquals(setOf("probe.Programs.sum"), rounds.map { it.getString("function") }.toSet())
        assertEquals(setOf(1), rounds.map { it.getInt("exports") }.toSet())

        val error = events.getValue("collektive.ProgramError").single()
        assertEquals(listOf("probe", 5, 1L), listOf(error.getString("program"), error.getInt("node"), error.getLong("tick")))
        assertContains(error.getString("message"), "broken")
        assertEquals(listOf(42L, 42L), events.getValue("collektive.SessionStart").map { it.getLong("seed") })
        assertEquals(listOf(TICKS, 1L), events.getValue("collektive.SessionEnd").sortedBy { it.startTime }.map { it.getLong("ticks") })
        assertTrue(events.getValue("collektive.SlotGrown").all { it.getLong("after") > it.getLong("before") })
    }

    @Tag("repeats")
    @Test
    fun `a dump contains the recording so far, and the recording continues`() {
        val dump = folder.resolve("dump.jfr")
        val file = folder.resolve("all.jfr")
        start(file)
        val session = TestSession(shim).apply { open() }
        session.ok(Step(1))
        assertEquals(RecordingState.On, control.record(RecordingAction.Dump, path = dump.toString()).recording())
        session.ok(Step(2))
        session.close()
        val end = control.record(RecordingAction.Stop)
        assertEquals(RecordingState.Off, end.recording())
        assertEquals(file.toString(), end.recordingPath())
        assertEquals(1, read(dump).getValue("collektive.Tick").size)
        assertEquals(2, read(file).getValue("collektive.Tick").size)
    }

    @Test
    fun `an action requested while another runs is done after it`() {
        val file = folder.resolve("short.jfr")
        control.ask(recording = RecordingAction.Start, path = file.toString())
        control.ask(recording = RecordingAction.Stop)
        val states = generateSequence { control.ask().recording().also { Thread.sleep(1) } }.takeWhile { it != RecordingState.Off }.toSet()
        assertTrue(RecordingState.On !in states, "the state must not be On after the request to stop")
        assertTrue(file.exists(), "no $file")
    }

    @Test
    fun `settings are default, profile or a file, which may disable events`() {
        val settings = folder.resolve("few.jfc")
        settings.writeText(
            """<?xml version="1.0" encoding="UTF-8"?><configuration version="2.0">
               <event name="collektive.Tick"><setting name="enabled">false</setting></event></configuration>""",
        )
        val file = folder.resolve("few.jfr")
        start(file, settings.toString())
        TestSession(shim).apply {
            open()
            ok(Step(1))
            close()
        }
        control.record(RecordingAction.Stop)
        val events = read(file)
        assertNull(events["collektive.Tick"])
        assertNotNull(events["collektive.SessionEnd"])
        assertNull(start(folder.resolve("profile.jfr"), "profile").recordingError())
    }

    @Test
    fun `an action that fails reports the reason, and the next one works`() {
        assertContains(refused { control.record(RecordingAction.Stop).recordingError() }, "no recording is running")
        assertContains(refused { start(folder.resolve("a.jfr"), "fast").recordingError() }, "unknown settings 'fast'")
        assertContains(refused { start(folder.resolve("a.jfr"), "$folder/none.jfc").recordingError() }, "none.jfc")
        assertContains(refused { start(folder).recordingError() }, "is a folder")
        val broken = Files.writeString(folder.resolve("broken.jfc"), "<configuration")
        assertContains(refused { start(folder.resolve("a.jfr"), broken.toString()).recordingError() }, "broken.jfc")
        val first = folder.resolve("a.jfr")
        assertNull(start(first).recordingError())
        assertContains(refused { start(folder.resolve("b.jfr")).recordingError() }, "a recording to $first is already running")
        val file = Files.writeString(folder.resolve("file"), "")
        assertNotNull(control.record(RecordingAction.Dump, path = "$file/x.jfr").recordingError())
        assertNull(control.record(RecordingAction.Stop).recordingError())
        assertTrue(first.exists(), "no $first")
        assertFalse(folder.resolve("a.jfr.part").exists())
    }

    private fun refused(action: () -> String?) =
        action().orEmpty().also { text -> assertTrue(shim.logs.any { it.second == text }, "'$text' is not in the log: ${shim.logs}") }

    private fun start(file: Path, settings: String = "default") = control.record(RecordingAction.Start, settings, file.toString())

    private fun read(file: Path): Map<String, List<RecordedEvent>> = RecordingFile.readAllEvents(file).groupBy { it.eventType.name }

    private companion object {
        // In a network with a multiple of the interval, the sampled nodes must also change from tick to tick.
        const val NODES = 2 * RoundSampling.INTERVAL
        const val TICKS = 51L
    }
}
