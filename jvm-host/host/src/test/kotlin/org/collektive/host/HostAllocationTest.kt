package org.collektive.host

import com.sun.management.ThreadMXBean
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import java.lang.management.ManagementFactory
import java.nio.file.Files
import kotlin.test.assertTrue

/** Tests that the host's thread allocates nothing per tick after a warm-up, because it reads frames and writes answers in place. */
@Tag("slow")
@Timeout(60)
class HostAllocationTest {
    private val threads = ManagementFactory.getThreadMXBean() as ThreadMXBean

    @Test
    fun `no allocation per tick on the engine thread`() = assertNoneIn(TestSession(TestShim()).apply { open(program = "probe") })

    @Test
    fun `a recorded tick does not allocate either`() {
        val file = Files.createTempFile("collektive", ".clkrec")
        assertNoneIn(TestSession(TestShim()).apply { open(program = "probe", record = file.toString()) })
        Files.delete(file)
    }

    private fun assertNoneIn(session: TestSession) {
        session.ok(
            Step(1).apply {
                added = (0 until 200).map { Step.Added(it) }
                due = (0 until 200).toList()
            },
        )
        val frame = Step(2).apply { due = (0 until 200).toList() }.bytes()
        val tickAt = frame.tickPosition()
        var tick = 2L
        fun ticks(count: Int, allocates: Boolean): Long {
            val before = threads.getThreadAllocatedBytes(Thread.currentThread().id)
            repeat(count) {
                frame.putLong(tickAt, tick++)
                if (allocates) control = LongArray(100)
                assertTrue(session.step(frame) >= 0, "the step must succeed")
            }
            return (threads.getThreadAllocatedBytes(Thread.currentThread().id) - before) / count
        }
        ticks(3000, false)
        val control = (1..3).minOf { ticks(500, true) }
        assertTrue(control >= 800, "the control run allocates 816 B, so at least 800 B must be measured, not $control B")
        val bytes = (1..3).minOf { ticks(500, false) }
        // The rest is the test's own duplicate of the answer.
        assertTrue(bytes <= WRAPPER_BYTES, "$bytes B were allocated per tick")
        session.close()
    }

    private var control = LongArray(0)

    private fun java.nio.ByteBuffer.tickPosition(): Int = (0 until capacity() - 8).first { getLong(it) == 2L }

    private companion object {
        /** The size of the object that `ByteBuffer.duplicate` creates in [TestSession]. */
        const val WRAPPER_BYTES = 128
    }
}
