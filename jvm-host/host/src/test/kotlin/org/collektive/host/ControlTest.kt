package org.collektive.host

import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import org.junit.jupiter.api.assertThrows
import java.lang.management.ManagementFactory
import java.nio.ByteBuffer
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Tests that control frames report the state of the JVM. */
@Timeout(60)
class ControlTest {
    private val shim = TestShim()
    private val control = TestControl(shim)

    @Test
    fun `flags have their effective values, and unknown flags are omitted`() {
        val answer = control.ask(flags = listOf("MaxHeapSize", "UseNoSuchThing", "TieredCompilation"))
        assertEquals(listOf("MaxHeapSize", "TieredCompilation"), (0 until answer.flagsLength()).map { answer.flags(it).name() })
        assertTrue(answer.flags(0).value().toLong() in 1..ManagementFactory.getMemoryMXBean().heapMemoryUsage.max * 2)
        assertEquals("true", answer.flags(1).value())
    }

    @Test
    fun `memory and classes are counted, after a collection if requested`() {
        val before = control.ask().collections()
        val after = control.ask(collect = true)
        assertTrue(after.collections() > before)
        assertTrue(after.heapUsed() in 1..after.heapCommitted())
        assertTrue(after.metaspaceUsed() > 0)
        assertTrue(after.classes() > 1000)
    }

    @Test
    fun `a control that names a session is refused`() {
        Host.shim = shim
        assertEquals(
            HostError.ARGUMENT.code.toLong(),
            Host.control(3, ByteBuffer.allocateDirect(8), 0, 8, 7, ByteBuffer.allocateDirect(8), 1000),
        )
        assertContains(shim.error, "the session of a control request must be 0")
    }

    @Test
    fun `an unknown action is refused`() {
        assertContains(assertThrows<HostException> { control.ask(recording = 99) }.message.orEmpty(), "unknown recording action 99")
    }
}
