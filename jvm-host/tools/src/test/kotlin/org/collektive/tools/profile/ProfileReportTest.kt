package org.collektive.tools.profile

import jdk.jfr.Event
import jdk.jfr.Name
import jdk.jfr.Recording
import jdk.jfr.Timespan
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.io.IOException
import java.lang.management.ManagementFactory
import java.nio.file.Path
import java.time.Duration
import kotlin.io.path.readBytes
import kotlin.io.path.writeBytes
import kotlin.test.assertContains
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse

/** Tests the summary of flight recordings. */
internal class ProfileReportTest {
    @Test
    fun `a truncated recording is reported`(@TempDir folder: Path) {
        val whole = folder.resolve("whole.jfr")
        Recording().use {
            it.enable("jdk.JVMInformation")
            it.start()
            it.stop()
            it.dump(whole)
        }
        assertContains(ProfileReport().read(whole).text(), "no ticks")
        val bytes = whole.readBytes()
        val part = folder.resolve("part.jfr")
        for (length in bytes.indices step bytes.size / 40) {
            part.writeBytes(bytes.copyOf(length))
            assertFailsWith<IOException>("$length of ${bytes.size} bytes") { ProfileReport().read(part) }
        }
    }

    @Test
    fun `a sample belongs to the program that calls another program`(@TempDir folder: Path) {
        val file = folder.resolve("nested.jfr")
        Recording().use {
            it.enable("jdk.ExecutionSample").withPeriod(Duration.ofMillis(10))
            it.start()
            for ((name, function) in listOf("a" to "called", "b" to "calling")) {
                RoundEvent().apply {
                    program = name
                    this.function = "${javaClass.packageName}.ProfileReportTest\$Programs.$function"
                }.commit()
            }
            Programs.calling()
            it.stop()
            it.dump(file)
        }
        val (called, calling) = ProfileReport().read(file).text().substringAfter("program a ").split("program b ")
        assertFalse("% " in called, called)
        assertContains(calling, "Programs.called:")
    }

    @Test
    fun `percentiles are those of manifests`(@TempDir folder: Path) {
        val file = folder.resolve("ticks.jfr")
        Recording().use {
            it.start()
            for (number in 1..100L) {
                TickEvent().apply {
                    tick = number
                    rounds = Duration.ofMillis(number).toNanos()
                }.commit()
            }
            it.stop()
            it.dump(file)
        }
        assertContains(ProfileReport().read(file).text(), Regex("""rounds +50\.000 ms +99\.000 ms"""))
    }

    @Name("collektive.Tick")
    private class TickEvent : Event() {
        @JvmField var tick = 0L

        @JvmField var nodes = 1

        @JvmField var links = 0

        @JvmField var bytesIn = 0L

        @JvmField var bytesOut = 0L

        @JvmField @Timespan
        var rounds = 0L

        @JvmField @Timespan
        var write = 0L

        @JvmField @Timespan
        var wait = 0L
    }

    @Name("collektive.ProgramRound")
    private class RoundEvent : Event() {
        @JvmField var program = ""

        @JvmField var function = ""

        @JvmField var exports = 1
    }

    private object Programs {
        fun calling() = called()

        // Uses processor time, because a busy machine takes fewer samples per second.
        fun called(): Double {
            val threads = ManagementFactory.getThreadMXBean()
            val end = threads.currentThreadCpuTime + Duration.ofSeconds(1).toNanos()
            var sum = 0.0
            while (threads.currentThreadCpuTime < end) repeat(100_000) { sum += StrictMath.sqrt(sum + 1) }
            return sum
        }
    }
}
