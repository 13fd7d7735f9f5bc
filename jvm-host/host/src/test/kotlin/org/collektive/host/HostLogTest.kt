package org.collektive.host

import org.collektive.host.log.HostLog
import org.collektive.host.shim.LogLevel
import org.slf4j.LoggerFactory
import java.util.logging.LogManager
import kotlin.concurrent.thread
import kotlin.test.AfterTest
import kotlin.test.BeforeTest
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Tests that output, log lines and uncaught exceptions of programs appear in the shim's log with their origin. */
internal class HostLogTest {
    private val shim = TestShim()
    private val log = HostLog(shim)
    private val out = System.out
    private val err = System.err
    private val handler = Thread.getDefaultUncaughtExceptionHandler()

    @BeforeTest
    fun takeOver() = log.install()

    @AfterTest
    fun restoreStreams() {
        System.setOut(out)
        System.setErr(err)
        Thread.setDefaultUncaughtExceptionHandler(handler)
    }

    private fun logs() = shim.logs.toList()

    private fun round(vararg labels: String) {
        val session = TestSession(shim)
        assertEquals(true, session.open(program = "probe") >= 0, shim.error)
        val nodes = labels.indices.map { it + 4 }
        session.ok(
            Step(1).apply {
                added = nodes.map { Step.Added(it) }
                due = nodes
                sensors = labels.map { Step.Sensor(0, it) }
            },
        )
        session.close()
    }

    @Test
    fun `lines that a round prints or logs begin with node and program`() {
        round("print", "log", "slf4j")
        println("outside")
        assertContains(logs(), LogLevel.INFO to "[node 4, program probe] hello")
        assertContains(logs(), LogLevel.WARNING to "[node 4, program probe] careful")
        assertContains(logs(), LogLevel.WARNING to "[node 5, program probe] probe: watch out")
        assertContains(logs(), LogLevel.ERROR to "[node 6, program probe] probe: it broke")
        assertContains(logs(), LogLevel.INFO to "outside")
    }

    @Test
    fun `lines of a thread that a round started begin with that round`() {
        round("thread")
        assertTrue(logs().any { it.second.startsWith("[thread of-probe of node 4, program probe] from afar") }, "${logs()}")
    }

    @Test
    fun `a thrown exception is one entry with its stack`() {
        LoggerFactory.getLogger("probe").error("it broke", IllegalStateException("inside"))
        val entry = logs().single().second
        assertTrue(entry.startsWith("probe: it broke\njava.lang.IllegalStateException: inside\n\tat "), entry)
    }

    @Test
    fun `an unterminated line is cut at the limit, and flushing ends it`() {
        print("x".repeat(5000))
        System.out.flush()
        assertEquals(listOf(4096, 904), logs().map { it.second.length })
    }

    @Test
    fun `a line is cut between characters`() {
        for (character in listOf("\u00E4", "\u20AC", "\uD83D\uDE80")) {
            for (before in 0..4) {
                val text = "x".repeat(before) + character.repeat(3000)
                println(text)
                assertEquals(text, logs().joinToString("") { it.second })
                assertTrue(logs().all { it.second.encodeToByteArray().size <= 4096 })
                shim.logs.clear()
            }
        }
    }

    @Test
    fun `a line of maximum length is one entry`() {
        println("x".repeat(4096))
        assertEquals(listOf(4096), logs().map { it.second.length })
    }

    @Test
    fun `an uncaught exception is logged once, then counted`() {
        repeat(25) { thread { error("number $it") }.join() }
        val first = logs()
        assertEquals(2, first.size, "$first")
        assertEquals(LogLevel.ERROR, first[0].first)
        assertContains(first[0].second, "an uncaught exception ended the thread: java.lang.IllegalStateException: number 0")
        assertContains(first[1].second, "10 times so far")
        log.logCounts()
        assertContains(logs().last().second, "25 times so far")
        log.logCounts()
        assertEquals(3, logs().size)
    }

    @Test
    fun `streams that a program closes or replaces are restored by the next session`() {
        System.out.close()
        println("still there")
        System.setOut(null)
        System.setErr(null)
        LogManager.getLogManager().reset()
        log.install()
        println("back")
        LoggerFactory.getLogger("probe").info("back too")
        assertEquals(listOf("still there", "back", "probe: back too"), logs().map { it.second })
    }
}
